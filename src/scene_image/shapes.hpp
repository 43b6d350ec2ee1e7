// Shapes of a Scene as records: each in single precision, in the space that its primitive in the kernel
// wants.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"
#include "prepare/eye.hpp"

namespace celltrace {

/// What of a record depends on the shape and its transformation alone.
struct PlacedShape {
  std::uint32_t kind_and_flags = 0;
  float geometry[12] = {};
  float parameters[2] = {0, 0}; ///< the first values of an ExtraRecord
  bool has_parameters = false;
  bool is_bounded = true;
  /// Nothing can hit it: a sphere without a radius.
  bool is_empty = false;

  kernel::Aabb bounds() const;
};

/// Writes an affine map as records have it: three rows of four.
void write_map(const Transform& map, float (&to)[12]);

/// Of a shape that is neither a mesh nor a CSG. Throws InputError if its transformation is singular.
PlacedShape place_shape(const Object& object);

/// Returns whether with_boundary() changes a shape.
bool has_boundary(const PlacedShape& shape);
/// The shape as points are tested against that lie on its surface but for rounding: those are in a box, in a
/// half-space and in an open cylinder or cone, but not in a closed one, as in POV-Ray. Where surfaces of a
/// CSG coincide, it depends on that which of them is seen. `eye`: where most rays begin.
PlacedShape with_boundary(const PlacedShape& shape, const Eye& eye);

/// Whether the bounds of such a shape are finite, without those that CSG may give it.
bool has_bounds(const Object& object);

/// Throws InputError, beginning with `name`, if a number of such a shape is not finite.
void validate_shape(const Object& object, const std::string& name);

} // namespace celltrace
