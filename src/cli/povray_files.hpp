// Finds the configuration files of POV-Ray, of the system and of its users.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace celltrace::cli {

/// The places of POV-Ray's own files.
struct PovrayPlaces {
  std::filesystem::path home; ///< empty if the user has none
  std::filesystem::path ini;  ///< an INI file to read before others; empty if there is none
  std::vector<std::filesystem::path>
      system_folders; ///< for povray.ini and povray.conf; the first one that has the file counts
  std::filesystem::path installation; ///< POV-Ray's own folder, which contains `include`
};

/// Returns HOME and POVINI of the environment, /etc/povray/3.7 and /usr/share/povray-3.7 (or those below
/// /usr/local).
PovrayPlaces povray_places();

/// Returns the single INI file that POV-Ray reads before its command line: the first that can be opened of
/// $POVINI, ./povray.ini, ~/.povray/3.7/povray.ini, povray.ini of the system and ~/.povrayrc. Adds a line to
/// `notes` if $POVINI cannot be opened.
std::optional<std::filesystem::path> find_povray_ini(const PovrayPlaces& places,
                                                     std::vector<std::string>& notes);

} // namespace celltrace::cli
