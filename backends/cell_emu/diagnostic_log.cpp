#include "backends/cell_emu/diagnostic_log.hpp"

#include <string_view>

namespace celltrace::cell_emu {

std::string to_text(const CallSite& site) {
  if (site.line == 0) return site.function;
  const std::string_view file = site.file;
  const std::size_t slash = file.find_last_of('/');
  std::string text(slash == std::string_view::npos ? file : file.substr(slash + 1));
  // Appended piece by piece, because GCC 12 warns of an overlapping copy in the sum of a literal and a
  // temporary.
  text += ':';
  text += std::to_string(site.line);
  if (*site.function != 0) text.append(" in ").append(site.function);
  return text;
}

DiagnosticLog::DiagnosticLog(const EmulationConfig& config, Listener listener)
    : listener_(std::move(listener)) {
  for (unsigned rule = 0; rule < kRules; ++rule)
    actions_[rule] = default_action(static_cast<Rule>(rule));
  for (const auto& [rule, action] : config.actions)
    if (static_cast<unsigned>(rule) < kRules) actions_[static_cast<unsigned>(rule)] = action;
}

bool DiagnosticLog::note(Diagnostic& diagnostic, const std::string& what) {
  diagnostic.action = action(diagnostic.rule);
  if (diagnostic.action == Action::ignore) return false;
  diagnostic.text = diagnostic.spe == Diagnostic::kPpe ? "PPE" : "SPE " + std::to_string(diagnostic.spe);
  diagnostic.text += ": " + what + " [" + std::string(name_of(diagnostic.rule));
  if (diagnostic.command != 0) diagnostic.text += ", command " + std::to_string(diagnostic.command);
  if (const std::string site = to_text(diagnostic.site); !site.empty()) diagnostic.text += ", at " + site;
  diagnostic.text += "]";
  const std::lock_guard lock(mutex_);
  if (diagnostics_.size() < kCapacity) {
    diagnostics_.push_back(diagnostic);
    if (listener_) listener_(diagnostic);
  }
  return true;
}

void DiagnosticLog::report(Diagnostic diagnostic, const std::string& what) {
  if (note(diagnostic, what) && diagnostic.action == Action::stop) throw RuleViolation(diagnostic);
}

std::vector<Diagnostic> DiagnosticLog::all() const {
  const std::lock_guard lock(mutex_);
  return diagnostics_;
}

} // namespace celltrace::cell_emu
