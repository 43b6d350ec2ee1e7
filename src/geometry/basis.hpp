// Axes around a direction.
#pragma once

#include "celltrace/transform.hpp"

#include <cmath>

#include <glm/geometric.hpp>

namespace celltrace {

/// Finds two directions that are at right angles to `axis` and to each other, all of unit length.
inline void complete_basis(const Vec3& axis, Vec3& first, Vec3& second) {
  const Vec3 other = std::abs(axis.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  first = glm::normalize(glm::cross(axis, other));
  second = glm::cross(axis, first);
}

} // namespace celltrace
