// Reads lists of plain numbers and vectors, of which meshes, matrices and most shapes consist, straight from
// the text.
#pragma once

#include <cstddef>
#include <vector>

#include "pov/location.hpp"
#include "pov/quantity.hpp"

namespace celltrace::pov {

class Names;

/// A number or vector in one of mesh2's lists, or in a matrix.
struct ListEntry {
  Vec3 v{0, 0, 0}; ///< a number fills all components
  bool is_float = false;

  ListEntry() = default;
  /// Converts a quantity; if any component is not finite, the entry is not finite either.
  explicit ListEntry(const Quantity& quantity);
};

/// Reads entries at the front of a list, or of the rest of one, and appends them to `list` until that has
/// `most`. Returns the first character that was not read. The text ends with a NUL before `end`.
///
/// An entry is taken only if the grammar could read it in no other way: all of it is a literal as the lexer
/// knows it, or a number with a sign in front, followed by a literal after a comma or, before a vector, after
/// nothing. Anything else, including the last entry and every error, is left to the grammar.
const char* take_literals(const char* text, const char* end, std::vector<ListEntry>& list, std::size_t most);

/// A number or vector among the arguments of a shape.
struct ShapeArgument {
  Quantity value;
  Location where;
};

/// The place of a literal in the text, and its value.
struct Literal {
  const char* begin = nullptr;
  const char* end = nullptr;
  Quantity value;
};

/// Reads the next argument of a shape, behind a comma unless it `is_first`. Returns false, and leaves the
/// argument to the grammar, unless it is a literal, or a number with a sign in front, and is followed by a
/// comma, a closing brace or a reserved word, so that nothing more can belong to it. `text` and `end` as
/// above.
bool read_argument(const char* text, const char* end, bool is_first, const Names& names, Literal& literal);

} // namespace celltrace::pov
