// The place of an operation in a kernel, for the diagnostics of a machine that checks. Freestanding C++17.
#pragma once

#include <stdint.h>

namespace celltrace {

/// A place in source text. As a default argument `CallSite site = CallSite::here()` it is the place of the
/// call.
struct CallSite {
  const char* file = "";
  uint32_t line = 0; ///< from 1; 0: unknown
  /// For machine code: the function; if calls were inlined, the line and function that each was called from,
  /// ", inlined from work.hpp:180 in half"; last the offset from the symbol table's entry. Else "".
  const char* function = "";

  static constexpr CallSite here(const char* file = __builtin_FILE(), uint32_t line = __builtin_LINE()) {
    return {file, line, ""};
  }
};

} // namespace celltrace
