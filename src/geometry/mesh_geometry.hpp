// Triangles and meshes in double precision, as other shapes are in shape_geometry.hpp.
#pragma once

#include "geometry/shape_geometry.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace celltrace::geometry {

/// `normals`: those of its corners, which are blended, or null for that of its plane.
void cross_triangle(const std::array<Vec3, 3>& corners, const Vec3* normals, const Ray& ray,
                    Crossings& found);

void find_crossings(const Mesh& mesh, const Ray& ray, Crossings& found);
/// Of some of its triangles.
void find_crossings(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const Ray& ray,
                    Crossings& found);

/// Whether the ray from there along the mesh's inside vector, if it has one, crosses an odd number of
/// triangles.
bool is_inside(const Mesh& mesh, const Vec3& point);
/// `triangles`: with all that this ray crosses.
bool is_inside(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const Vec3& point);

/// Around its triangles; a point if there are none.
Extent extent_of(const Mesh& mesh);

} // namespace celltrace::geometry
