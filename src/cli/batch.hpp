// Renders many scenes one after the other: `celltrace in/*.pov -o DIR/`.
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

/// Renders all scenes, even if one fails, and writes the page `contact-sheet.html` beside the pictures.
/// Creates the folder if it is missing. Returns the exit code: 1 if a scene failed, 2 after an interrupt,
/// else 0.
int run_batch(const BatchRequest& batch);

} // namespace celltrace::cli
