// How the program stands in for povray under other programs.
#pragma once

#include "celltrace/pov.hpp"
#include "cli/povray_files.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// Whether the program stands in for povray: it does if it is started under that name, unless the last
/// --povray on|off among the arguments says otherwise. `program` is the name that it was started by.
bool stands_in_for_povray(std::string_view program, const std::vector<std::string>& arguments);

/// The text for stderr, where POV-Ray writes it, if the arguments ask povray for its version or for help.
std::optional<std::string> povray_information(const std::vector<std::string>& arguments);

/// Arguments that precede a client's own: POV-Ray's defaults where it has others than this program, and its
/// INI file. Adds lines to `notes` for files that cannot be used.
std::vector<std::string> povray_defaults(const PovrayPlaces& places, std::vector<std::string>& notes);

/// Lets a scene read and write what povray.conf permits, in the current folder unless it says where. Adds
/// lines to `warnings` for what is wrong with povray.conf.
void permit_as_povray(ParseOptions& options, const PovrayPlaces& places, std::vector<std::string>& warnings);

} // namespace celltrace::cli
