// Vectors and affine transformations, as POV-Ray has them.
#pragma once

#include "celltrace/export.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace celltrace {

using Vec3 = glm::dvec3;
using Vec3f = glm::vec3;
using Vec2f = glm::vec2;

/// An affine transformation as POV-Ray writes it: row vectors, p' = p * rows[0..2] + rows[3].
struct CELLTRACE_EXPORT Transform {
  Vec3 rows[4] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};

  static Transform translate(const Vec3& offset);
  /// Rotates about x, then y, then z, in degrees, left-handed. NaN if an angle is not finite.
  static Transform rotate(const Vec3& degrees);
  /// Scales along the axes; a factor of 0 counts as 1, as in POV-Ray.
  static Transform scale(const Vec3& factors);
  static Transform matrix(const double (&values)[12]);

  Vec3 point(const Vec3& p) const { return p.x * rows[0] + p.y * rows[1] + p.z * rows[2] + rows[3]; }
  Vec3 direction(const Vec3& d) const { return d.x * rows[0] + d.y * rows[1] + d.z * rows[2]; }
  /// Transforms a normal by the inverse transpose; the result is not normalised.
  Vec3 normal(const Vec3& n) const;
  double determinant() const;
  /// Throws InputError if the transformation is singular.
  Transform inverse() const;
  /// Returns the transformation that first applies this transformation, then `next`.
  Transform then(const Transform& next) const;
  bool is_identity() const;
};

} // namespace celltrace
