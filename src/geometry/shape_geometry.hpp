// Queries of shapes, each in its own space, in double precision on the host: for the scene language, and to
// find the media in which a point is. The kernel's primitives have the same surfaces in single precision.
#pragma once

#include "celltrace/scene.hpp"
#include "geometry/extent.hpp"

#include <vector>

namespace celltrace {

/// Limit on the nesting of CSG and clipping around a shape: in a Scene, in the object of a pattern, and in
/// objects of the language. Functions that walk such a tree recurse once per level, on a thread's stack of
/// unknown size, and a hundred levels are far more than scenes have.
inline constexpr int kDeepestCsg = 100;

} // namespace celltrace

namespace celltrace::geometry {

struct Ray {
  Vec3 origin, direction; ///< of any length but 0
  Vec3 at(double t) const { return origin + direction * t; }
};

/// A point where a ray crosses a surface: the ray's origin plus `t` times the ray's direction.
struct Crossing {
  double t;
  Vec3 normal; ///< points outwards; of any length
};
using Crossings = std::vector<Crossing>;

using Shape = decltype(Object::shape);

/// The exponents in a superellipsoid's equation.
struct Powers {
  double across; ///< exponent of x and y
  double along;  ///< exponent of z
};
Powers powers_of(const Superellipsoid& superellipsoid);

/// Appends all crossings, in any order, including those behind the origin. A CSG has none.
void find_crossings(const Shape& shape, const Ray& ray, Crossings& found);

/// Returns whether a point is inside. Flat shapes have half-spaces as their inside; a mesh has an inside if
/// it has an inside vector. Always false for a CSG.
bool is_inside(const Shape& shape, const Vec3& point);

/// Returns POV-Ray's box around a transformed shape; infinite for a CSG.
Extent extent_of(const Shape& shape, const Transform& transform);

/// Returns the box of a plane's half-space that is part of an intersection. The box is infinite, except on
/// one side if the plane is at right angles to an axis.
Extent half_space(const Plane& plane, const Transform& transform, bool is_inverse);

} // namespace celltrace::geometry
