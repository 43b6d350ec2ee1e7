// Characters of the scene language's strings, which are bytes; those past Latin-1 are in UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace celltrace::pov {

/// The character with a code of at most 65535: one byte up to 255, UTF-8 from there on. Nothing for 0.
std::string character(unsigned code);

/// The code of the first character; 0 of an empty text.
unsigned first_code(std::string_view text);

} // namespace celltrace::pov
