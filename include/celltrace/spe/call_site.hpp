// Where in a kernel an operation stands, for the diagnostics of a machine that checks. Freestanding C++17.
#pragma once

#include <stdint.h>

namespace celltrace {

/// A place in source text. As a default argument `CallSite site = CallSite::here()` it is the place of the
/// call.
struct CallSite {
  const char* file = "";
  uint32_t line = 0; ///< from 1; 0: unknown
  /// Of machine code: the function; where calls were inlined, from which line of which function each was
  /// called, ", inlined from work.hpp:180 in half"; at last the offset in what the symbol table names. Else
  /// "".
  const char* function = "";

  static constexpr CallSite here(const char* file = __builtin_FILE(), uint32_t line = __builtin_LINE()) {
    return {file, line, ""};
  }
};

} // namespace celltrace
