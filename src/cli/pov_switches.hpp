// Translates POV-Ray's command line (its manual, section "Command-line and INI-file options") into
// celltrace's.
#pragma once

#include "cli/ini_file.hpp"
#include "cli/pov_translation.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// Access to the files that a command line names.
struct PovFiles {
  /// Returns whether there is a file, other than a folder.
  std::function<bool(const std::string& name)> exists;
  TextReader read = read_ini_text;
};
/// Returns access to the file system.
PovFiles real_files();

/// Translates switches such as +W640, -D and +Iscene.pov, in either case, settings such as Width=640 and INI
/// files, FILE.ini or FILE.ini[SECTION], in the arguments of `render`; all other arguments pass through
/// unchanged, as do all arguments after "--" and the values of celltrace's own options. The last one of a
/// repeated switch, setting or scene counts. Arguments that begin with another command or ask for help or the
/// version are returned as they are. Throws InputError for a switch or setting that is unknown, lacks its
/// value, or would change the picture in a way that is not supported yet; the error includes the line of an
/// INI file.
Translation translate_pov_switches(const std::vector<std::string>& arguments,
                                   const PovFiles& files = real_files());

/// Returns whether the arguments are those of `render`, whose name is optional.
bool is_for_render(const std::vector<std::string>& arguments);

/// Returns whether the argument is one of celltrace's own options, and the next one its value.
bool takes_the_next_argument(std::string_view argument);

/// Returns whether the arguments are those of `render`, whose name is optional.
bool is_for_render(const std::vector<std::string>& arguments);

/// Returns whether the argument is one of celltrace's own options, and the next one its value.
bool takes_the_next_argument(std::string_view argument);

} // namespace celltrace::cli
