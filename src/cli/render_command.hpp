// celltrace render
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

/// Parses, renders and saves; progress and summary go to stderr, statistics to their file. Returns the exit
/// code: 0, or 2 if interrupted (the partial picture is saved). Throws the library's exceptions.
int run_render(const RenderRequest& request);

} // namespace celltrace::cli
