// The statistics of a run of a program for the SPU, as JSON.
#pragma once

#include "celltrace/simulator.hpp"

#include <string>

namespace celltrace::cli {

/// Returns the JSON that docs/statistics.md describes. `seconds` is the host's time.
std::string spu_statistics(const SimulatedRun& run, const MachineConfig& config, double seconds);

} // namespace celltrace::cli
