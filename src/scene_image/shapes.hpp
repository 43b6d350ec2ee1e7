// Converts shapes of a Scene to records: each in single precision, in the space of its primitive in the
// kernel.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"
#include "prepare/eye.hpp"

namespace celltrace {

/// The part of an object's record that depends on the shape and its transformation alone.
struct PlacedShape {
  std::uint32_t kind_and_flags = 0;
  float geometry[12] = {};
  float parameters[2] = {0, 0}; ///< the first values of an ExtraRecord
  bool has_parameters = false;
  bool is_bounded = true;
  /// True if nothing can hit it, as a sphere without a radius.
  bool is_empty = false;

  kernel::Aabb bounds() const;
};

/// Writes an affine map as records have it: three rows of four.
void write_map(const Transform& map, float (&to)[12]);

/// Returns the record of a shape that is neither a mesh nor a CSG. Throws InputError if its transformation is
/// singular.
PlacedShape place_shape(const Object& object);

bool has_boundary(const PlacedShape& shape);
/// Returns the shape that points are tested against if rounding alone moves them off its surface. As in
/// POV-Ray, such points are inside of a box, a half-space and an open cylinder or cone, but not of a closed
/// one; this decides which of the coinciding surfaces of a CSG is seen. `eye` is where most rays begin.
PlacedShape with_boundary(const PlacedShape& shape, const Eye& eye);

/// Returns whether the shape of an object has finite bounds, not counting those that CSG may give it.
bool has_bounds(const Object& object);

/// Throws InputError, beginning with `name`, if a number of the object's shape is not finite.
void validate_shape(const Object& object, const std::string& name);

} // namespace celltrace
