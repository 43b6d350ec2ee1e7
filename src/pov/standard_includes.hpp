// The files that POV-Ray brings along for scenes to include.
#pragma once

#include <string>
#include <string_view>

namespace celltrace::pov {

/// The Debian package that has them.
inline constexpr const char* kStandardIncludesPackage = "povray-includes";

/// Whether POV-Ray 3.7 brings a file of this name along; case does not count.
bool is_standard_include(std::string_view name);

/// Returns the installed include file that declares this name, or makes a macro of it; "" if none does, or
/// none is installed. Reads them all: for errors.
std::string include_that_declares(std::string_view name);

} // namespace celltrace::pov
