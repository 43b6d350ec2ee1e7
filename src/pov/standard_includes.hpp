// The include files that POV-Ray brings along.
#pragma once

#include <string>
#include <string_view>

namespace celltrace::pov {

/// The Debian package with these files.
inline constexpr const char* kStandardIncludesPackage = "povray-includes";

/// Returns whether POV-Ray 3.7 brings along a file of this name, ignoring case.
bool is_standard_include(std::string_view name);

/// Returns the installed include file that declares this name, or defines a macro of it; "" if no file does,
/// or none is installed. Slow, for errors only: reads all of them.
std::string include_that_declares(std::string_view name);

} // namespace celltrace::pov
