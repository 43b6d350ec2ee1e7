#include "backends/cell_emu/scheduler.hpp"

#include "celltrace/spe/channels.hpp"

namespace celltrace::cell_emu {
namespace {

std::string where(const ProblemState::Stall& stall) {
  std::string text =
      "channel " + std::to_string(static_cast<unsigned>(stall.channel)) + " (" + name_of(stall.channel) + ")";
  if (const std::string site = to_text(stall.site); !site.empty()) text += " at " + site;
  return text;
}

/// Returns a description of what an SPE waits for; "" if it does not wait.
std::string describe(const Spe& spe) {
  const std::string name = "SPE " + std::to_string(spe.id);
  if (const auto stall = spe.state.stall()) return name + " waits at " + where(*stall) + "; ";
  if (!spe.running || !spe.paused()) return "";
  return name + " has stopped with code " + std::to_string(spe.signal.load()) + " and waits to be resumed; ";
}

} // namespace

std::string report_deadlock(Spes& spes, DiagnosticLog& log, const std::string& ppe_waits_for) {
  std::string text = "deadlock: ";
  for (const auto& spe : spes)
    text += describe(*spe);
  text += "the PPE waits for " + ppe_waits_for;
  bool told = false;
  for (const auto& spe : spes) {
    const auto stall = spe->state.stall();
    if (!stall || (told && !stall->after_phantom)) continue;
    Diagnostic diagnostic;
    diagnostic.rule = stall->after_phantom ? Rule::phantom_event : Rule::deadlock;
    diagnostic.spe = spe->id;
    diagnostic.site = stall->site;
    diagnostic.cycle = spe->now;
    // The full text of a deadlock is reported for its first SPE only.
    const std::string what = told ? "waits at " + where(*stall) : text;
    told = true;
    log.note(diagnostic,
             stall->after_phantom ? what + ": " + std::string(text_of(Rule::phantom_event)) : what);
  }
  return text;
}

} // namespace celltrace::cell_emu
