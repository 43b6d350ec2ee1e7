// Many scenes one after the other: `celltrace in/*.pov -o DIR/`.
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

/// Renders all scenes, also after one that fails, and writes the page `contact-sheet.html` beside the
/// pictures. Makes the folder if it is not there. Returns the exit code: 1 if a scene failed, 2 after an
/// interrupt, else 0.
int run_batch(const BatchRequest& batch);

} // namespace celltrace::cli
