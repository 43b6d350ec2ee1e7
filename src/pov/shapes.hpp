// Shapes that are written as a name and a list of numbers, as in sphere { centre, radius }. Each shape is one
// entry of a table in shapes.cpp: its name, its parameters and the function that makes it a shape of the
// Scene. The language's words and the messages about wrong arguments come from this table, too.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pov/literals.hpp"
#include "pov/curves.hpp"
#include "pov/location.hpp"
#include "pov/object.hpp"
#include "pov/quantity.hpp"

namespace celltrace::pov {

struct Session;

/// A shape as written, before its arguments are checked.
struct WrittenShape {
  int number = 0; ///< index in shape_names()
  Location where;
  std::vector<ShapeArgument> arguments;
  bool is_open = false;          ///< followed by `open`
  std::optional<CurveKind> curve; ///< by the word in front of its arguments; null: there is none
  bool is_conic = false;         ///< `conic_sweep` stands in front of its arguments
  bool is_swept = false;         ///< `linear_sweep` or `conic_sweep` stands there
  bool is_component = false;     ///< a component of a blob, whose last argument may be its strength
  std::optional<Location> comma; ///< behind the last argument
};

std::vector<const char*> shape_names();
/// Returns whether a shape, by its index in shape_names(), has optional arguments after the required ones.
bool has_option(int shape);

/// Returns whether a shape has all its arguments if there are `count`, and takes no vector as the next one.
bool is_complete(int shape, std::size_t count);

/// Returns the shape; fails if the arguments are not right for it.
Shape read_shape(Session& session, const WrittenShape& written);

/// Returns whether POV-Ray shows nothing of a shape that stands alone, because its bounding box is empty.
bool is_invisible(const Shape& shape);

} // namespace celltrace::pov
