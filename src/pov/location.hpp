// The place of a token.
#pragma once

#include <cstdint>

namespace celltrace::pov {

/// A file of the parse (see Sources), a line and a column in bytes, both from 1.
struct Location {
  std::uint32_t file = 0;
  std::uint32_t line = 1;
  std::uint32_t column = 1;

  bool operator==(const Location&) const = default;
};

} // namespace celltrace::pov
