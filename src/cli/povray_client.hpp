// Lets the program stand in for povray under other programs.
#pragma once

#include "celltrace/pov.hpp"
#include "cli/povray_files.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// Returns whether the program stands in for povray: true if it was started under that name, `program`,
/// unless the last --povray on|off among the arguments says otherwise.
bool stands_in_for_povray(std::string_view program, const std::vector<std::string>& arguments);

/// Returns the text for stderr, where POV-Ray writes it, if the arguments ask povray for its version or for
/// help.
std::optional<std::string> povray_information(const std::vector<std::string>& arguments);

/// Returns arguments that precede a client's own: POV-Ray's defaults that differ from this program's, and its
/// INI file. Adds lines to `notes` for files that cannot be used.
std::vector<std::string> povray_defaults(const PovrayPlaces& places, std::vector<std::string>& notes);

/// Lets a scene read and write what povray.conf permits; relative names are in the current folder. Adds lines
/// to `warnings` for errors in povray.conf.
void permit_as_povray(ParseOptions& options, const PovrayPlaces& places, std::vector<std::string>& warnings);

} // namespace celltrace::cli
