// The meaning of the language's words.
#pragma once

#include <string_view>
#include <vector>

#include "pov/names.hpp"

namespace celltrace::pov {

struct ReservedWord {
  const char* text;
  int token; ///< of the grammar
  int detail;
  bool is_unsupported;
};
std::vector<ReservedWord> reserved_words();

/// Returns the meaning of a word behind a dot: a component 0 to 4, 5 for the grey value, -1 for none.
int component_of(std::string_view word);
/// Returns the meaning of a word behind a #.
Directive directive_of(std::string_view word);

} // namespace celltrace::pov
