// Arguments of POV-Ray's command line and lines of INI files, split into switches, settings and files.
#pragma once

#include "cli/pov_settings.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

struct PovEntry {
  enum class Kind {
    option, ///< a switch: +W640
    setting,
    file ///< the name of a scene or an INI file
  };

  Kind kind;
  std::string text = {};               ///< text as written, for messages
  const PovSetting* setting = nullptr; ///< null for a file, and for an unknown switch or setting
  bool plus = false;                   ///< the sign of a switch
  std::string value = {};              ///< without quotes around it
  bool in_quotes = false;              ///< the value was quoted
  std::string left_out = {};           ///< rest of a file's line after a quoted value
};

/// Splits one argument. A value ends at a blank, but the name of a file or a folder continues until something
/// else begins: the shell's quotes, which held the argument together, are gone. Quotes of both kinds hold
/// their contents together. Throws InputError for letters right after a closing quote.
std::vector<PovEntry> split_argument(std::string_view argument);

/// Splits one line of an INI file. The value of a setting, and the name of a file, reach to the end of the
/// line or to a comment, which begins with ; or #. Text after a quoted value is ignored. Throws InputError
/// for quotes that are not closed.
std::vector<PovEntry> split_ini_line(std::string_view line);

} // namespace celltrace::cli
