#include "backends/cell_emu/scheduler.hpp"

#include "celltrace/spe/channels.hpp"

namespace celltrace::cell_emu {
namespace {

std::string describe(const Spe& spe, const ProblemState::Stall& stall) {
  std::string text = "SPE " + std::to_string(spe.id) + " waits at channel " +
                     std::to_string(static_cast<unsigned>(stall.channel)) + " (" + name_of(stall.channel) +
                     ")";
  if (const std::string site = to_text(stall.site); !site.empty()) text += " at " + site;
  return text;
}

} // namespace

std::string report_deadlock(Spes& spes, DiagnosticLog& log, const std::string& ppe_waits_for) {
  std::string text = "deadlock: ";
  for (const auto& spe : spes)
    if (const auto stall = spe->state.stall()) text += describe(*spe, *stall) + "; ";
  text += "the PPE waits for " + ppe_waits_for;
  for (const auto& spe : spes) {
    const auto stall = spe->state.stall();
    if (!stall) continue;
    Diagnostic diagnostic;
    diagnostic.rule = stall->after_phantom ? Rule::phantom_event : Rule::deadlock;
    diagnostic.spe = spe->id;
    diagnostic.site = stall->site;
    diagnostic.cycle = spe->now;
    std::string what = text;
    if (stall->after_phantom) what += ": " + std::string(text_of(Rule::phantom_event));
    log.note(diagnostic, what);
  }
  return text;
}

} // namespace celltrace::cell_emu
