// POV-Ray's INI files: lines in sections.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// Returns the text of a file; throws InputError, naming it, if it cannot be read.
using TextReader = std::function<std::string(const std::string& file)>;
/// Reads at most a megabyte.
std::string read_ini_text(const std::string& file);

struct IniLine {
  std::string_view text; ///< without its line end
  int number;            ///< from 1 on
};

struct IniLines {
  std::vector<IniLine> lines;
  bool has_section = false; ///< the requested section exists
};

/// Returns the lines before the first [section], and those of sections with this name, in either case; an
/// empty name matches no section. Lines end with LF, CR LF or CR, and a byte order mark may precede the first
/// one. The lines point into `text`.
IniLines parse_ini(std::string_view text, std::string_view section);

/// Returns whether a file begins with settings or switches instead of a scene.
bool looks_like_ini(std::string_view text);

} // namespace celltrace::cli
