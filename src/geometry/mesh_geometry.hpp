// Queries of triangles and meshes in double precision; shape_geometry.hpp has queries of other shapes.
#pragma once

#include "geometry/shape_geometry.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace celltrace::geometry {

/// Appends the crossing of a ray with a triangle. `normals` are the normals at the corners, which are
/// interpolated; null for the normal of the plane.
void cross_triangle(const std::array<Vec3, 3>& corners, const Vec3* normals, const Ray& ray,
                    Crossings& found);

void find_crossings(const Mesh& mesh, const Ray& ray, Crossings& found);
/// Appends the crossings with some triangles of a mesh.
void find_crossings(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const Ray& ray,
                    Crossings& found);

/// Returns whether the ray from a point along the mesh's inside vector crosses an odd number of triangles;
/// false if the mesh has no inside vector.
bool is_inside(const Mesh& mesh, const Vec3& point);
/// Returns whether a point is inside, as above; `triangles` must include all triangles that the ray crosses.
bool is_inside(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const Vec3& point);

/// Returns a box around the triangles; a point if the mesh has no triangles.
Extent extent_of(const Mesh& mesh);

} // namespace celltrace::geometry
