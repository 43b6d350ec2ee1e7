// The files of a render, before it starts.
#pragma once

#include "cli/command_line.hpp"

namespace celltrace::cli {

/// Makes a folder, and those around it, if it is not there. Throws InputError if it cannot be made.
void make_folder(const std::filesystem::path& folder);

/// Sees to it that no two files of a render are the same, by whatever name, and that those that are written
/// in the end can be; a pipe whose reader is gone becomes an error like others. A report that would take the
/// picture's place is said on standard error output and taken out of the request, as pictures take longest:
/// false then, for which the program fails in the end. Makes the picture's folder if it is to. Throws
/// InputError if two reports are the same file, if one is the scene, or if one cannot be written.
bool prepare_outputs(RenderRequest& request);

} // namespace celltrace::cli
