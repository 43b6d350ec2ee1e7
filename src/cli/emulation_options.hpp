// The options that only cell_emu has: schedule, seed, transfers, faults, timing, limits, traces.
#pragma once

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

void add_emulation_options(CLI::App& command, EmulationTexts& texts);

/// What they say together. Throws InputError if they contradict each other or the backend. Where the
/// traces go stays unset.
EmulationConfig emulation_config(const EmulationTexts& texts, const std::string& backend);

} // namespace celltrace::cli
