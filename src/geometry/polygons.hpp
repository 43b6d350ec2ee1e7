// Polygons in the planes that they lie in, and as triangles.
#pragma once

#include "celltrace/scene.hpp"

#include <optional>

namespace celltrace {

/// From the space of the kernel's polygon to this one: its square from -1 to 1 in x and y is just around the
/// points, its z axis is the normal, which is that of the first corner that is one: (b - a) x (c - a).
/// Nothing if the polygon has no area.
std::optional<Transform> frame_of(const Polygon& polygon);

/// Makes triangles of a polygon, transformed to the world; none if the polygon is not convex, has many
/// corners or its points lie beside the plane.
Mesh triangles_of(const Polygon& polygon, const Transform& to_world);

} // namespace celltrace
