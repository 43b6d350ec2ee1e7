// Renders the frames of an animation into numbered pictures or a film.
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

/// Runs a request for an animation or a film, which may have a single frame. Returns the exit code: 0, or 2
/// if it was interrupted.
int run_animation(const RenderRequest& request);

} // namespace celltrace::cli
