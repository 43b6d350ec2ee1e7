// Height fields: a picture's or a function's values as a surface over a square. They become triangles, as in
// POV-Ray.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "pov/location.hpp"
#include "pov/object.hpp"
#include "pov/pictures.hpp"
#include "pov/user_function.hpp"

namespace celltrace::pov {

/// Heights of a grid of points over the square from 0 to 1 in x and z, and how their surface looks.
struct HeightField {
  int width = 0, height = 0;
  /// Heights of 0 to 65535, row by row; the first row is at z = 1. Shared by copies.
  std::shared_ptr<const std::vector<std::uint16_t>> heights;
  double water_level = 0; ///< 0 to 1: nothing below is seen
  bool is_smooth = false;
};

/// Returns the heights that POV-Ray takes from a picture.
HeightField height_field_of(Session& session, const WrittenPicture& written);
/// Returns the heights that a function has over the square. Fails if the grid is too small or too large.
HeightField height_field_of(Session& session, const UserFunction& function, double width, double height,
                            const Location& where);

/// Returns the object of a height field, in the unit cube.
std::shared_ptr<ObjectDefinition> height_field(Session& session, const HeightField& field, const Location& where);
/// Changes an option of an object that is a height field; fails if it is none.
void change_height_field(Session& session, ObjectDefinition& object, const std::function<void(HeightField&)>& change,
                         const Location& where);

} // namespace celltrace::pov
