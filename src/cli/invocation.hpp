// What the program was started with, besides its arguments: its name, the environment, POV-Ray's INI file.
#pragma once

#include "cli/command_line.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

struct Invocation {
  Request request;
  /// One line for each argument, or file, that has no effect here and does no harm.
  std::vector<std::string> notes;
};

/// Reads the arguments of a program that was started by the name `program`. Before those of `render` stand,
/// in place of povray, POV-Ray's defaults, and then the words of CELLTRACE_OPTIONS; the last counts. In place
/// of povray the scene is looked for in the library paths, too, and INI files in those of the defaults.
/// Throws InputError; it names CELLTRACE_OPTIONS where the arguments are valid without that.
Invocation read_invocation(std::string_view program, const std::vector<std::string>& arguments);

} // namespace celltrace::cli
