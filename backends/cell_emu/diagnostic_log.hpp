// Collects the diagnostics of a machine, and applies the configured actions.
#pragma once

#include "celltrace/error.hpp"
#include "celltrace/spe/emulation.hpp"

#include <array>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace celltrace::cell_emu {

/// The exception that ends an SPE's program because the program broke a rule.
class RuleViolation : public SpeError {
public:
  explicit RuleViolation(const Diagnostic& diagnostic) : SpeError(diagnostic.text) {}
};

/// The diagnostics of a machine. Thread safety: all members from any thread.
class DiagnosticLog {
public:
  static constexpr std::size_t kCapacity = 4096;
  using Listener = std::function<void(const Diagnostic&)>;

  explicit DiagnosticLog(const EmulationConfig& config, Listener listener = {});

  Action action(Rule rule) const { return actions_[static_cast<unsigned>(rule)]; }
  bool checks(Rule rule) const { return action(rule) != Action::ignore; }

  /// Keeps a diagnostic whose text describes the event by `what`. Throws RuleViolation if the rule's action
  /// is Action::stop. Does nothing if the rule is ignored.
  void report(Diagnostic diagnostic, const std::string& what);
  /// As report(), but never throws, and completes `diagnostic`. Returns false if the rule is ignored.
  bool note(Diagnostic& diagnostic, const std::string& what);

  std::vector<Diagnostic> all() const;

private:
  std::array<Action, kRules> actions_;
  Listener listener_;
  mutable std::mutex mutex_;
  std::vector<Diagnostic> diagnostics_;
};

/// Returns "kernel.hpp:12", or "" if the place is unknown.
std::string to_text(const CallSite& site);

} // namespace celltrace::cell_emu
