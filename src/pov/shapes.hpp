// Shapes that are written as a name and a list of numbers, as in sphere { centre, radius }. Each of them is
// one entry of a table in shapes.cpp: its name, its parameters and how they become a shape of the Scene. The
// language's words and the messages about wrong arguments come from there too.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pov/literals.hpp"
#include "pov/location.hpp"
#include "pov/object.hpp"
#include "pov/quantity.hpp"

namespace celltrace::pov {

struct Session;

/// A shape as written, before its arguments are checked.
struct WrittenShape {
  int number = 0; ///< its place in shape_names()
  Location where;
  std::vector<ShapeArgument> arguments;
  bool is_open = false;          ///< `open` stands behind them
  std::optional<Location> comma; ///< behind the last one
};

/// All of them.
std::vector<const char*> shape_names();
/// Whether something may be left out behind what such a shape has to have; by its place in shape_names().
bool has_option(int shape);

/// Whether such a shape has all its arguments with so many, and takes no vector as the next one.
bool is_complete(int shape, std::size_t count);

/// Fails if the arguments are not the shape's.
Shape read_shape(Session& session, const WrittenShape& written);

/// Whether POV-Ray shows nothing of a shape that stands alone, because its bounding box is empty.
bool is_invisible(const Shape& shape);

} // namespace celltrace::pov
