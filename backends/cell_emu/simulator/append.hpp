// append(), which formats text for tables.
#pragma once

#include <string>

namespace celltrace::cell_emu {

/// Appends to `text`, formatted as by printf(), up to 511 characters.
[[gnu::format(printf, 2, 3)]] void append(std::string& text, const char* format, ...);

} // namespace celltrace::cell_emu
