// celltrace render
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

/// Parses, renders and saves; progress and summary go to stderr, statistics where they are asked for. Returns
/// the exit code: 0, or 2 if interrupted (the partial picture is saved). Throws what the library throws.
int run_render(const RenderRequest& request);

} // namespace celltrace::cli
