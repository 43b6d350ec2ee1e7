// Lists of numbers and vectors without any arithmetic, which is what meshes and matrices consist of, read
// straight from the text.
#pragma once

#include <cstddef>
#include <vector>

#include "pov/quantity.hpp"

namespace celltrace::pov {

/// A number or vector of one of mesh2's lists, or of a matrix.
struct ListEntry {
  Vec3 v{0, 0, 0}; ///< a number fills all of it
  bool is_float = false;

  ListEntry() = default;
  /// One that is not finite stays so, whichever of its components is to blame.
  explicit ListEntry(const Quantity& quantity);
};

/// Reads entries at the front of a list or of what is left of it, and appends them to `list` until that has
/// `most`. Returns the first character that was not read. The text ends with a NUL before `end`.
///
/// An entry is taken only where the grammar could not understand anything else: if all of it is a literal as
/// the lexer knows it, or a number with a sign in front, and a comma or, before a vector, nothing stands
/// between it and the literal that follows. Whatever else
/// there is, the last entry included, is left to the grammar, and with it every error.
const char* take_literals(const char* text, const char* end, std::vector<ListEntry>& list, std::size_t most);

} // namespace celltrace::pov
