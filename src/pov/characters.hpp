// Characters of the scene language's strings, which are bytes; characters past Latin-1 are in UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace celltrace::pov {

/// Returns the character with a code of at most 65535: one byte up to 255, UTF-8 from there on. Code 0 gives
/// an empty string.
std::string character(unsigned code);

/// Returns the code of the first character; 0 for an empty text.
unsigned first_code(std::string_view text);

} // namespace celltrace::pov
