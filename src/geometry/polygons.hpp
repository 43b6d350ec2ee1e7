// Polygons in their own planes, and as triangles.
#pragma once

#include "celltrace/scene.hpp"

#include <optional>

namespace celltrace {

/// Returns the transformation from the space of the kernel's polygon to the polygon's: the square from -1 to
/// 1 in x and y becomes the rectangle just around the points, and the z axis becomes the normal, which is (b
/// - a) x (c - a) of the first corner that is not flat. Returns nothing if the polygon has no area.
std::optional<Transform> frame_of(const Polygon& polygon);

/// Returns the triangles of a polygon, transformed to the world; none if the polygon is not convex, has many
/// corners, or has points off its plane.
Mesh triangles_of(const Polygon& polygon, const Transform& to_world);

} // namespace celltrace
