// celltrace spu
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

// Exit codes for the run instead of the program. A program may end with them as well: --stats tells the two
// apart.
constexpr int kSpuLimitReached = 124;
constexpr int kSpuRunFailed = 125;
constexpr int kSpuInterrupted = 130;

/// Runs a program for the SPU on every SPE of a machine. The program's output goes to stdout and stderr
/// immediately; warnings and errors of the run go to stderr. Returns the exit code: the program's (with
/// several SPEs, the first that is not 0), or one of the above. Throws InputError for files that cannot be
/// used.
int run_spu(const SpuRequest& request);

} // namespace celltrace::cli
