// Checks the files of a render before it starts.
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

/// Makes a folder and its parents if they are missing. Throws InputError if that fails.
void make_folder(const std::filesystem::path& folder);

/// Ensures that no two files of a render are the same, under any name, and that the outputs can be written;
/// makes writing to a pipe without a reader an error like others. Creates the picture's folder if requested.
/// A report that would replace the picture is reported on stderr and removed from the request, since pictures
/// take longest; the function then returns false, and the program fails at the end. Throws InputError if two
/// reports are the same file, if one is the scene, or if one cannot be written.
bool prepare_outputs(RenderRequest& request);

} // namespace celltrace::cli
