// Reads the circumstances in which the program was started: its arguments and name, the environment,
// POV-Ray's INI file.
#pragma once

#include "cli/command_line.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

struct Invocation {
  Request request;
  /// Notes, one line for each argument, or file, that is ignored without harm.
  std::vector<std::string> notes;
};

/// Reads the arguments of a program that was started under the name `program`. The arguments of `render` are
/// preceded by the words of CELLTRACE_OPTIONS and, if the program stands in for povray, by POV-Ray's defaults
/// before these; the last one counts. In place of povray, the scene is also looked for in the library paths,
/// and INI files in those of the defaults. Throws InputError; the message names CELLTRACE_OPTIONS if the
/// arguments are valid without it.
Invocation read_invocation(std::string_view program, const std::vector<std::string>& arguments);

} // namespace celltrace::cli
