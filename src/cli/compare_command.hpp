// celltrace compare
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

/// Prints one line (or JSON) to stdout and writes the difference picture if requested. Returns the exit code:
/// 0, or 1 if a limit was given and not reached. Throws InputError for pictures that cannot be read or
/// compared.
int run_compare(const CompareRequest& request);

} // namespace celltrace::cli
