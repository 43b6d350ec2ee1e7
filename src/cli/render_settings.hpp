// The settings that the pixels of a request depend on: a run may continue with another one's rows if these
// are equal.
#pragma once

#include "cli/command_line.hpp"
#include "cli/resume_state.hpp"

namespace celltrace::cli {

/// Returns the settings of a request, but not the files that its scene includes.
Settings settings_of(const RenderRequest& request);

} // namespace celltrace::cli
