// Lists of numbers and vectors without any arithmetic, which is what meshes, matrices and most shapes consist
// of, read straight from the text.
#pragma once

#include <cstddef>
#include <vector>

#include "pov/location.hpp"
#include "pov/quantity.hpp"

namespace celltrace::pov {

class Names;

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

/// A number or vector that a shape is given.
struct ShapeArgument {
  Quantity value;
  Location where;
};

/// Where a literal stands in the text, and what it says.
struct Literal {
  const char* begin = nullptr;
  const char* end = nullptr;
  Quantity value;
};

/// Reads the next argument of a shape, behind a comma unless it `is_first`. False, and it is left to the
/// grammar, unless it is a literal, or a number with a sign in front, and nothing that follows can belong to
/// it: a comma, a closing brace or a reserved word. `text` and `end` as above.
bool read_argument(const char* text, const char* end, bool is_first, const Names& names, Literal& literal);

} // namespace celltrace::pov
