// Shapes other than spheres and triangles in double precision, in their own space, and the insides of all
// objects.
#pragma once

#include "celltrace/scene.hpp"

#include <vector>

namespace celltrace::reference {

/// The real zeros of coefficients[0] + coefficients[1] x + ..., of the fourth degree at most, in ascending
/// order; of a zero that the function only touches, perhaps none.
std::vector<double> real_zeros(const std::vector<double>& coefficients);

/// Where a line crosses the surface of an object's shape, without its transformation, in any order.
/// `direction` may have any length. Nothing of meshes and CSG.
std::vector<double> crossings(const Object& object, const Vec3& origin, const Vec3& direction);
/// Of any length, at a point of the surface.
Vec3 local_normal(const Object& object, const Vec3& point);

/// Whether a point of the space that an object is placed in is inside it, or of a CSG, and in what clips it.
bool is_inside(const Object& object, const Vec3& point);

} // namespace celltrace::reference
