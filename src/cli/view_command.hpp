// celltrace view: a window on a scene.
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

/// Runs the window. Returns the exit code. Throws InputError if this build has no windows, else as
/// viewer::view() does.
int run_view(const ViewRequest& request);

} // namespace celltrace::cli
