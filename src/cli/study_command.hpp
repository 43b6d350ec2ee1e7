// `celltrace study`.
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

/// Prints the tables and writes their files. Returns the exit code: 0, even if a claim does not hold, since
/// that is a result.
int run_study_command(const StudyRequest& request);

} // namespace celltrace::cli
