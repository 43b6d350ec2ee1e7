// The files that set POV-Ray up: where a system and its users have them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace celltrace::cli {

/// Where POV-Ray's own files are looked for.
struct PovrayPlaces {
  std::filesystem::path home; ///< empty: the user has none
  std::filesystem::path ini;  ///< an INI file to read before others; empty: none
  std::vector<std::filesystem::path>
      system_folders;                 ///< with povray.ini and povray.conf, the first that has it
  std::filesystem::path installation; ///< POV-Ray's own, with its folder `include`
};

/// HOME and POVINI of the environment, /etc/povray/3.7 and /usr/share/povray-3.7 (or those below /usr/local).
PovrayPlaces povray_places();

/// The INI file that POV-Ray reads before its command line, which is one only: the first that can be opened
/// of $POVINI, ./povray.ini, ~/.povray/3.7/povray.ini, povray.ini of the system and ~/.povrayrc. Adds a line
/// to `notes` if $POVINI cannot be opened.
std::optional<std::filesystem::path> find_povray_ini(const PovrayPlaces& places,
                                                     std::vector<std::string>& notes);

} // namespace celltrace::cli
