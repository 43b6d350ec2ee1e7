// The bounds of a transformed box.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"

#include <glm/common.hpp>

namespace celltrace {

/// Bounds in the world, in double precision.
class WorldBox {
public:
  WorldBox() = default;
  WorldBox(const kernel::Aabb& box, const Transform& transform) {
    const Vec3 low(box.min[0], box.min[1], box.min[2]), high(box.max[0], box.max[1], box.max[2]);
    const Vec3 centre = transform.point(0.5 * (low + high));
    const Vec3 half = 0.5 * (high - low);
    Vec3 reach(0);
    for (int row = 0; row < 3; ++row)
      reach += half[row] * glm::abs(transform.rows[row]);
    min_ = centre - reach;
    max_ = centre + reach;
  }

  void grow(const WorldBox& other) {
    min_ = glm::min(min_, other.min_);
    max_ = glm::max(max_, other.max_);
  }
  const Vec3& min() const { return min_; }
  const Vec3& max() const { return max_; }
  /// Returns half the surface area.
  double area() const {
    const Vec3 e = max_ - min_;
    return e.x * e.y + (e.x + e.y) * e.z;
  }

private:
  Vec3 min_ = Vec3(1e300), max_ = Vec3(-1e300);
};

} // namespace celltrace
