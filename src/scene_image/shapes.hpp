// Converts shapes of a Scene to fields of records. Each shape is in single precision, in the own space of its
// primitive in the kernel.
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
  /// True if no ray can hit the shape, such as a sphere without a radius.
  bool is_empty = false;

  kernel::Aabb bounds() const;
};

/// Writes an affine map as records have it: three rows of four numbers.
void write_map(const Transform& map, float (&to)[12]);

/// Returns the record of a shape that is neither a mesh nor a CSG. Throws InputError if the object's
/// transformation is singular.
PlacedShape place_shape(const Object& object);

bool has_boundary(const PlacedShape& shape);
/// Returns a slightly larger or smaller shape, against which CSG tests points. As in POV-Ray, points that
/// only rounding moves off the surface of `shape` are then inside of a box, a half-space and an open cylinder
/// or cone, but outside of a closed cylinder or cone. This decides which of several coinciding surfaces of a
/// CSG is seen. `eye` is where most rays begin.
PlacedShape with_boundary(const PlacedShape& shape, const Eye& eye);

/// Returns whether the shape of an object has finite bounds, not counting bounds that CSG may give it.
bool has_bounds(const Object& object);

/// Throws InputError, with a message that begins with `name`, if a number of the shape is not finite.
void validate_shape(const Object& object, const std::string& name);

} // namespace celltrace
