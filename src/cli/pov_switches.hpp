// POV-Ray's own command line (its manual, section "Command-line and INI-file options"), put into celltrace's
// words.
#pragma once

#include "cli/ini_file.hpp"
#include "cli/pov_translation.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// The files that a command line names.
struct PovFiles {
  /// Says whether there is a file, which is no folder.
  std::function<bool(const std::string& name)> exists;
  TextReader read = read_ini_text;
};
/// Those of the file system.
PovFiles real_files();

/// Translates switches such as +W640, -D and +Iscene.pov, in either case, settings such as Width=640 and INI
/// files, FILE.ini or FILE.ini[SECTION], in the arguments of `render`; everything else passes through
/// unchanged, also whatever follows "--" or is the value of one of celltrace's own options. Of a switch,
/// setting or scene that is repeated the last counts. Arguments that begin with another command or ask for
/// help or the version are returned as they are. Throws InputError for a switch or setting that is unknown,
/// lacks its value, or would change the picture in a way that is not supported yet; in an INI file with its
/// line.
Translation translate_pov_switches(const std::vector<std::string>& arguments,
                                   const PovFiles& files = real_files());

/// Whether the arguments are those of `render`, which its name need not precede.
bool is_for_render(const std::vector<std::string>& arguments);

/// Whether the argument is one of celltrace's own options, and the next one its value.
bool takes_the_next_argument(std::string_view argument);

/// Whether the arguments are those of `render`, which its name need not precede.
bool is_for_render(const std::vector<std::string>& arguments);

/// Whether the argument is one of celltrace's own options, and the next one its value.
bool takes_the_next_argument(std::string_view argument);

} // namespace celltrace::cli
