// Shapes in double precision, on the host, each in its own space: what the language asks of objects, and how
// a point's media are found. The kernel's primitives say the same in single precision.
#pragma once

#include "celltrace/scene.hpp"
#include "geometry/extent.hpp"

#include <vector>

namespace celltrace {

/// Levels of CSG and clipping that a shape may be in: in a Scene, in the object of a pattern, and in what the
/// language makes. Whatever walks such a tree calls itself once a level, on a thread's stack of unknown size,
/// and a hundred is far more than scenes have.
inline constexpr int kDeepestCsg = 100;

} // namespace celltrace

namespace celltrace::geometry {

struct Ray {
  Vec3 origin, direction; ///< of any length but 0
  Vec3 at(double t) const { return origin + direction * t; }
};

/// Where a ray goes through a surface, `t` times its direction away.
struct Crossing {
  double t;
  Vec3 normal; ///< outwards, of any length
};
using Crossings = std::vector<Crossing>;

using Shape = decltype(Object::shape);

/// The powers in a superellipsoid's equation.
struct Powers {
  double across; ///< of x and y
  double along;  ///< of z
};
Powers powers_of(const Superellipsoid& superellipsoid);

/// Appends all of them, in any order, also those behind the origin. None of a CSG.
void find_crossings(const Shape& shape, const Ray& ray, Crossings& found);

/// Flat shapes have half-spaces inside; a mesh has an inside if it has an inside vector. Never in a CSG.
bool is_inside(const Shape& shape, const Vec3& point);

/// POV-Ray's box around a shape that is placed; everywhere of a CSG.
Extent extent_of(const Shape& shape, const Transform& transform);

/// That of the half-space of a plane which is a part of an intersection: smaller if it is along an axis.
Extent half_space(const Plane& plane, const Transform& transform, bool is_inverse);

} // namespace celltrace::geometry
