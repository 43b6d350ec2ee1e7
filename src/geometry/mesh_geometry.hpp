// Triangles and meshes in double precision, as shape_geometry.hpp has other shapes.
#pragma once

#include "geometry/shape_geometry.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace celltrace::geometry {

/// Appends the crossing of a ray with a triangle. `normals` are those of the corners, which are interpolated,
/// or null for the normal of the plane.
void cross_triangle(const std::array<Vec3, 3>& corners, const Vec3* normals, const Ray& ray,
                    Crossings& found);

void find_crossings(const Mesh& mesh, const Ray& ray, Crossings& found);
/// Appends the crossings with some triangles of a mesh.
void find_crossings(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const Ray& ray,
                    Crossings& found);

/// Returns whether the ray from a point along the mesh's inside vector, if the mesh has one, crosses an odd
/// number of triangles.
bool is_inside(const Mesh& mesh, const Vec3& point);
/// Returns the same; `triangles` must include all that this ray crosses.
bool is_inside(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const Vec3& point);

/// Returns a box around the triangles; a point if there are none.
Extent extent_of(const Mesh& mesh);

} // namespace celltrace::geometry
