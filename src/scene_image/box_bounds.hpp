// What boxes along the axes of the world leave of a region, and where their own faces are in it: bounds of
// what CSG cuts in half, or cuts the corner off.
#pragma once

#include "kernel/aabb.hpp"
#include "scene_image/shapes.hpp"

#include <optional>

namespace celltrace {

/// The corners of a shape that is a box whose faces are at right angles to the axes; none of any other.
std::optional<kernel::Aabb> box_along_axes(const PlacedShape& shape);

/// Around what is in `within` but not in `box`, and a little more: less than `within` where the box reaches
/// across it on two axes. `within` may reach to infinity, as the greatest floats, and may be empty.
kernel::Aabb left_by_box(const kernel::Aabb& box, const kernel::Aabb& within);

/// Around those parts of a box's faces that are in `within`, and a little more; empty if none is.
kernel::Aabb bounds_of_faces(const kernel::Aabb& box, const kernel::Aabb& within);

} // namespace celltrace
