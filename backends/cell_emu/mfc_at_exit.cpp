// Mfc::finish(): at the end of a kernel the MFC completes all commands, and reports what the program has left
// undone, such as transfers without a wait.
#include "backends/cell_emu/mfc.hpp"
#include "backends/cell_emu/mfc_rules.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <string>
#include <vector>

namespace celltrace::cell_emu {

void Mfc::finish(Cycle now) {
  while (next_event() != kNever)
    now = std::max(now, run_next());
  const auto still_stopped = [&](std::uint64_t command) {
    return std::any_of(queue_.begin(), queue_.end(), [&](const Entry& entry) {
      return !entry.proxy && entry.number == command && entry.stalled;
    });
  };
  const std::uint32_t idle_waits = waited_tags_ & ~used_tags_;
  std::optional<Diagnostic> first;
  std::uint64_t last = 0;
  const auto report_left = [&](const Entry& entry) {
    if (entry.number == last) return;
    last = entry.number;
    Diagnostic diagnostic = about(entry, Rule::in_flight_at_exit, now);
    std::string what = describe(entry.command) + ": " + std::string(text_of(Rule::in_flight_at_exit));
    if (still_stopped(entry.number)) what += "; its list is still stopped at a notify element";
    const bool kept = context_.log.note(diagnostic, what);
    if (kept && diagnostic.action == Action::stop && !first) first = diagnostic;
  };
  Diagnostic overrun;
  if (note_overrun(overrun, {}, now) && overrun.action == Action::stop) first = overrun;
  while (note_allocation_overrun(overrun, {}, now))
    if (overrun.action == Action::stop && !first) first = overrun;
  for (const Flight& flight : context_.flights.of(spe_)) {
    if (flight.proxy) continue;
    Diagnostic diagnostic;
    if (!flight.drained)
      report_left({flight.transfer, flight.command, flight.site, false, 0});
    else if (note_drained(FlightInfo(flight), diagnostic, now) && diagnostic.action == Action::stop && !first)
      first = diagnostic;
  }
  // A stopped list is not done, even if it has no flight because the program has observed the transferred
  // part.
  const std::vector<Flight>& flights = context_.flights.of(spe_);
  for (const Entry& entry : queue_)
    if (entry.stalled && !entry.proxy &&
        std::none_of(flights.begin(), flights.end(),
                     [&](const Flight& flight) { return flight.command == entry.number; }))
      report_left(entry);
  if (last != 0 && idle_waits != 0) {
    Diagnostic diagnostic = about({}, Rule::wait_without_command, now);
    diagnostic.tag = static_cast<std::uint32_t>(std::countr_zero(idle_waits));
    diagnostic.site = waits_[diagnostic.tag];
    context_.log.note(diagnostic, "tag groups 0x" + to_hex(idle_waits) + ": " +
                                      std::string(text_of(Rule::wait_without_command)));
  }
  if (tag_groups_.available() || tag_groups_.waiting()) {
    Diagnostic diagnostic = about({}, Rule::tag_status_unread, now);
    diagnostic.site = last_request_;
    context_.log.note(diagnostic, std::string(text_of(Rule::tag_status_unread)));
  }
  if (atomic_status_ && !first) {
    Diagnostic diagnostic =
        about({last_atomic_, commands_, last_atomic_site_, false, 0}, Rule::atomic_status_unread, now);
    if (context_.log.note(diagnostic,
                          describe(last_atomic_) + ": " + std::string(text_of(Rule::atomic_status_unread))) &&
        diagnostic.action == Action::stop)
      first = diagnostic;
  }
  abandon();
  if (first) throw RuleViolation(*first);
}

} // namespace celltrace::cell_emu
