// celltrace replay
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

/// Prints a table, or JSON, of the hits of caches of the requested shapes on a recorded trace, for all SPEs
/// together. Returns 0. Throws InputError for a trace that cannot be read.
int run_replay(const ReplayRequest& request);

} // namespace celltrace::cli
