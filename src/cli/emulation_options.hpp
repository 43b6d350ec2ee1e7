// The options that only emulated machines have: schedule, seed, transfers, faults, timing, limits, traces.
#pragma once

#include "celltrace/spe/backend.hpp"
#include "celltrace/spe/emulation.hpp"

#include <string>

namespace CLI {
class App;
}

namespace celltrace::cli {

/// The options as they were given; empty: not given.
struct EmulationTexts {
  std::string schedule;
  std::string seed;
  std::string transfers;
  bool faults = false;
  std::string timing;
  std::string cycle_limit;
  std::string seconds_limit;
  bool lenient = false;
  std::string trace;
  std::string cache_trace;
};

/// What every command has that runs emulated machines: all but --cache-trace. `default_schedule` is what
/// holds where neither --schedule nor --trace is given.
void add_emulation_options(CLI::App& command, EmulationTexts& texts, Schedule default_schedule);
/// For what runs the tracer.
void add_cache_trace_option(CLI::App& command, EmulationTexts& texts);

/// What they say together. Throws InputError if they contradict each other or the backend. Where the
/// traces go stays unset.
EmulationConfig emulation_config(const EmulationTexts& texts, Backend backend, Schedule default_schedule);

} // namespace celltrace::cli
