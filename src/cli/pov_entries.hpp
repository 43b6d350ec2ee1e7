// Arguments of POV-Ray's command line and lines of INI files, split into switches, settings and files.
#pragma once

#include "cli/pov_settings.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

struct PovEntry {
  enum class Kind {
    option, ///< +W640: a switch
    setting,
    file ///< the name of a scene or an INI file
  };

  Kind kind;
  std::string text = {};               ///< as written, for messages
  const PovSetting* setting = nullptr; ///< null: there is no such switch or setting; or a file
  bool plus = false;                   ///< the sign of a switch
  std::string value = {};              ///< without quotes around it
  bool in_quotes = false;              ///< the value was
  std::string left_out = {};           ///< behind the value in quotes on a line of a file
};

/// Splits one argument. A value ends at a blank, but a name of a file or a folder goes on until something
/// else begins: the shell's quotes, which held the argument together, are gone. Quotes of both kinds hold
/// together what is in them. Throws InputError for letters right behind a closing quote.
std::vector<PovEntry> split_argument(std::string_view argument);

/// Splits one line of an INI file. A value of a setting, and the name of a file, reach to the end of the line
/// or to a comment, which begins with ; or #. What stands behind a value in quotes is left out. Throws
/// InputError for quotes that are not closed.
std::vector<PovEntry> split_ini_line(std::string_view line);

} // namespace celltrace::cli
