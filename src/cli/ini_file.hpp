// POV-Ray's INI files: lines of sections.
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
  std::string_view text; ///< without what ends the line
  int number;            ///< from 1 on
};

struct IniLines {
  std::vector<IniLine> lines;
  bool has_section = false; ///< the section that was asked for
};

/// Returns the lines before the first [section], and those of sections with this name, in either case; an
/// empty name: of no section. Lines end with LF, CR LF or CR, and a byte order mark may precede the first
/// one. The lines are parts of `text`.
IniLines parse_ini(std::string_view text, std::string_view section);

/// Whether a file has settings or switches in front, and not a scene.
bool looks_like_ini(std::string_view text);

} // namespace celltrace::cli
