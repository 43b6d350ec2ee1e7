// POV-Ray's own command line (its manual, section "Command-line and INI-file options"), put into celltrace's
// words.
#pragma once

#include <string>
#include <vector>

namespace celltrace::cli {

struct Translation {
  /// Command first ("render" where none was given), in the terms of command_line.hpp.
  std::vector<std::string> arguments;
  /// One line for each switch that has no effect here and does no harm.
  std::vector<std::string> notes;
};

/// Translates switches such as +W640, -D and +Iscene.pov, in either case, and settings such as Width=640 in
/// the arguments of `render`; everything else passes through unchanged, also whatever follows "--" or is the
/// value of one of celltrace's own options. Arguments that begin with another command or ask for help or the
/// version are returned as they are. Throws InputError for a switch or setting that is unknown, lacks its
/// value, or would change the picture in a way that is not supported yet. A pure function.
Translation translate_pov_switches(const std::vector<std::string>& arguments);

} // namespace celltrace::cli
