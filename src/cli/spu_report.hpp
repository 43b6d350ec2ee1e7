// What a run of a program for the SPU cost, in words and as JSON.
#pragma once

#include "celltrace/simulator.hpp"

#include <string>

namespace celltrace::cli {

/// Counters of all SPEs together, in the order of IBM's full-system simulator; several lines.
std::string spu_summary(const SimulatedRun& run, const TimingParameters& timing);

/// What docs/statistics.md describes. `seconds` is the host's time.
std::string spu_statistics(const SimulatedRun& run, const MachineConfig& config, double seconds);

} // namespace celltrace::cli
