// The meaning of the language's words.
#pragma once

#include <string_view>
#include <vector>

#include "pov/names.hpp"

namespace celltrace::pov {

struct ReservedWord {
  const char* text;
  int token; ///< number of the grammar's token
  int detail;
  bool is_unsupported;
};
const std::vector<ReservedWord>& reserved_words();
/// Lists their meanings in each Block, in their order.
const std::vector<const Names::Meanings*>& reserved_meanings();

/// An item's word (items.hpp).
struct BlockWord {
  const char* text;
  Block block;
  int token;  ///< the grammar's
  int detail; ///< Item::row
  bool is_ignored;
};
/// All of them; of several for one word and block the first counts.
const std::vector<BlockWord>& block_words();

/// Returns the meaning of a word behind a dot: a component 0 to 4, 5 for the grey value, -1 for none.
int component_of(std::string_view word);
/// Returns the meaning of a word behind a #.
Directive directive_of(std::string_view word);

} // namespace celltrace::pov
