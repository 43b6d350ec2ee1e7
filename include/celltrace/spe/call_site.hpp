// CallSite: the place of an operation in a kernel's source, for diagnostics of the emulated Cell.
// Freestanding C++17.
#pragma once

#include <stdint.h>

namespace celltrace {

/// A place in source text. A function with the default argument `CallSite site = CallSite::here()` gets the
/// place of its call.
struct CallSite {
  const char* file = "";
  uint32_t line = 0; ///< from 1; 0: unknown
  /// For machine code: the function's name; for each inlined call, the line and function that it was called
  /// from (", inlined from work.hpp:180 in half"); last the offset from the function's symbol. Else "".
  const char* function = "";

  static constexpr CallSite here(const char* file = __builtin_FILE(), uint32_t line = __builtin_LINE()) {
    return {file, line, ""};
  }
};

} // namespace celltrace
