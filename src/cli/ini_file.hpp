// POV-Ray's INI files: switches and settings, as on its command line.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// Gives the text of a file; throws InputError, naming it, if it cannot be read.
using TextReader = std::function<std::string(const std::string& file)>;
/// Of at most a megabyte.
std::string read_ini_text(const std::string& file);

struct IniEntry {
  std::string text; ///< a switch, a file's name, or NAME=VALUE without quotes
  int line;         ///< from 1 on
};

/// The entries before the first [section], and those of sections with this name, in either case. Empty: of no
/// section. `name` stands in errors: throws InputError for a section that is not there and for quotes that
/// are not closed.
std::vector<IniEntry> parse_ini(std::string_view text, std::string_view section, const std::string& name);

} // namespace celltrace::cli
