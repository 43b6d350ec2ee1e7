// Options for emulated machines only: schedule, seed, transfers, faults, timing, limits, traces.
#pragma once

#include "celltrace/spe/backend.hpp"
#include "celltrace/spe/emulation.hpp"

#include <string>

namespace CLI {
class App;
}

namespace celltrace::cli {

/// The options as they were given; empty if they were not.
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

/// Adds the options of every command that runs emulated machines: all but --cache-trace. `default_schedule`
/// applies if neither --schedule nor --trace is given.
void add_emulation_options(CLI::App& command, EmulationTexts& texts, Schedule default_schedule);
/// Adds the option of commands that run the tracer.
void add_cache_trace_option(CLI::App& command, EmulationTexts& texts);

/// Returns the configuration that the options make together. Throws InputError if they contradict each other
/// or the backend. The files of traces stay unset.
EmulationConfig emulation_config(const EmulationTexts& texts, Backend backend, Schedule default_schedule);

} // namespace celltrace::cli
