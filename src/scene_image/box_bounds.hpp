// Bounds in CSG with a box along the axes of the world: bounds of a region without the box, which may cut the
// region in half or cut off a corner, and bounds of the box's faces inside a region.
#pragma once

#include "kernel/aabb.hpp"
#include "scene_image/shapes.hpp"

#include <optional>

namespace celltrace {

/// Returns the corners of a shape that is a box with faces at right angles to the axes; nothing for any other
/// shape.
std::optional<kernel::Aabb> box_along_axes(const PlacedShape& shape);

/// Returns slightly enlarged bounds of what is in `within` but not in `box`: smaller than `within` if the box
/// reaches across it on two axes. `within` may be infinite (the greatest floats) or empty.
kernel::Aabb left_by_box(const kernel::Aabb& box, const kernel::Aabb& within);

/// Returns slightly enlarged bounds of the parts of a box's faces that are in `within`; empty if there are
/// none.
kernel::Aabb bounds_of_faces(const kernel::Aabb& box, const kernel::Aabb& within);

} // namespace celltrace
