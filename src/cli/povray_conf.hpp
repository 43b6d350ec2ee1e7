// POV-Ray's povray.conf: the files that a scene may read and write, by folders.
#pragma once

#include "celltrace/pov.hpp"
#include "cli/povray_files.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// The files that a povray.conf lets scenes use; a larger number is stricter.
enum class FileSecurity {
  none,      ///< every file
  read_only, ///< every file for reading, the permitted folders for writing
  restricted ///< the permitted folders
};

struct PermittedFolder {
  std::filesystem::path folder; ///< canonical
  bool with_folders_below = false;
  bool may_be_written = false; ///< reading is permitted in any case
};

struct PovrayConf {
  FileSecurity security = FileSecurity::restricted;
  std::vector<PermittedFolder> folders;

  /// Returns whether a file may be used; `file` is absolute and has no links.
  bool permits(const std::filesystem::path& file, FileUse use) const;
};

/// Parses the text of a povray.conf. Relative folders begin in the current one; missing folders are ignored.
/// Lines that are not understood are ignored with a warning that begins with `name`, and never permit
/// anything: without a valid [File I/O Security] a scene is restricted, and of two values the stricter one
/// counts.
PovrayConf parse_povray_conf(std::string_view text, const std::string& name, const PovrayPlaces& places,
                             std::vector<std::string>& warnings);

/// Returns the permissions of the system's povray.conf and the user's, ~/.povray/3.7/povray.conf: scenes may
/// do what all existing ones permit. A file that exists but cannot be read permits nothing. If there is no
/// file, scenes may read where Debian's povray.conf lets them (POV-Ray's folders and $HOME), and read and
/// write in /tmp and in the current folder.
std::vector<PovrayConf> read_povray_confs(const PovrayPlaces& places, std::vector<std::string>& warnings);

} // namespace celltrace::cli
