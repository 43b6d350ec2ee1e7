#include "backends/cell_emu/config_rules.hpp"

#include "celltrace/error.hpp"

#include <string>

namespace celltrace::cell_emu {
namespace {

[[noreturn]] void refuse(const char* member, const std::string& what) {
  throw InputError("EmulationConfig::" + std::string(member) + " " + what);
}

/// Checks a range, which NaN is never in.
void in_range(const char* member, double value, double least, double most, const char* range) {
  if (!(value >= least && value <= most)) refuse(member, std::string("must be ") + range);
}

template <class Enumeration> void one_of(const char* member, Enumeration value, Enumeration last) {
  if (static_cast<unsigned>(value) > static_cast<unsigned>(last)) refuse(member, "has no such value");
}

void check_faults(const Faults& faults) {
  in_range("faults.slowest_spe", faults.slowest_spe, 1, 1000, "from 1 to 1000");
  in_range("faults.pause_probability", faults.pause_probability, 0, 1, "from 0 to 1");
}

void check_timing(const TimingParameters& timing) {
  in_range("timing.clock_hz", timing.clock_hz, 1000, 1e12, "from 1000 Hz to 1 THz");
  if (timing.cycles_per_tick == 0) refuse("timing.cycles_per_tick", "must be at least 1");
  if (timing.spes < 1 || timing.spes > kMaxSpes)
    refuse("timing.spes", "must be from 1 to " + std::to_string(kMaxSpes));
  in_range("timing.exposed_latency", timing.exposed_latency, 0, 1, "from 0 to 1");
  in_range("timing.hints", timing.hints, 0, 16, "from 0 to 16");
  in_range("timing.late_hint", timing.late_hint, 0, 16, "from 0 to 16");
  in_range("timing.no_ops", timing.no_ops, 0, 16, "from 0 to 16");
  in_range("timing.late_fetch", timing.late_fetch, 0, 16, "from 0 to 16");
  in_range("timing.paired_issue", timing.paired_issue, 0, 1, "from 0 to 1");
}

} // namespace

void check_emulation(const EmulationConfig& config) {
  one_of("schedule", config.schedule, Schedule::lockstep);
  one_of("transfers", config.transfers, TransferTime::random);
  check_faults(config.faults);
  check_timing(config.timing);
  for (const auto& [rule, action] : config.actions) {
    if (static_cast<unsigned>(rule) >= kRules) refuse("actions", "names a rule that does not exist");
    one_of("actions", action, Action::stop);
  }
  in_range("seconds_limit", config.seconds_limit, 0, 1e9, "from 0 to 1e9");
  if (config.trace != nullptr && config.schedule != Schedule::lockstep)
    throw InputError("a trace needs the lockstep schedule");
}

} // namespace celltrace::cell_emu
