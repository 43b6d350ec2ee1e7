// POV-Ray's povray.conf: the files that a scene may read and write, by folders.
#pragma once

#include "celltrace/pov.hpp"
#include "cli/povray_files.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// How a povray.conf limits scenes, by what it lets them use; a larger number is stricter.
enum class FileSecurity {
  none,      ///< every file
  read_only, ///< every file for reading, the permitted folders for writing
  restricted ///< the permitted folders
};

struct PermittedFolder {
  std::filesystem::path folder; ///< canonical
  bool with_folders_below = false;
  bool may_be_written = false; ///< it may be read in any case
};

/// The contents of one povray.conf.
struct PovrayConf {
  FileSecurity security = FileSecurity::restricted;
  std::vector<PermittedFolder> folders;

  /// `file` is absolute and has no links.
  bool permits(const std::filesystem::path& file, FileUse use) const;
};

/// Reads the text of a povray.conf. Relative folders begin in the current one; folders that are not there are
/// left out. Every line that is not understood is left out, too, with a warning that begins with `name`, and
/// never permits anything: without a valid [File I/O Security] a scene is restricted, and of two values the
/// stricter one counts.
PovrayConf parse_povray_conf(std::string_view text, const std::string& name, const PovrayPlaces& places,
                             std::vector<std::string>& warnings);

/// The permissions of the system's povray.conf and the user's, ~/.povray/3.7/povray.conf: scenes may do what
/// all of them permit that are there. A file that is there but cannot be read permits nothing. Where there is
/// none, scenes may read what Debian's povray.conf lets them read (POV-Ray's folders and $HOME) and write,
/// with reading, in /tmp and in the current folder.
std::vector<PovrayConf> read_povray_confs(const PovrayPlaces& places, std::vector<std::string>& warnings);

} // namespace celltrace::cli
