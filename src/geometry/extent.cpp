#include "geometry/extent.hpp"

#include <algorithm>

#include <glm/common.hpp>

namespace celltrace {

namespace {

constexpr double kFarthest = 1e10;

} // namespace

Extent Extent::everywhere() {
  return {Vec3(-kFarthest), Vec3(kFarthest)};
}

Extent Extent::around(const std::vector<Vec3>& points) {
  Extent extent{points.front(), points.front()};
  for (const Vec3& point : points)
    extent = {glm::min(extent.min, point), glm::max(extent.max, point)};
  return extent;
}

bool Extent::is_everywhere() const {
  return min.x <= -kFarthest || min.y <= -kFarthest || min.z <= -kFarthest || max.x >= kFarthest ||
         max.y >= kFarthest || max.z >= kFarthest;
}

double Extent::volume() const {
  const Vec3 size = max - min;
  return size.x * size.y * size.z;
}

Extent Extent::moved(const Transform& transform) const {
  if (is_everywhere()) return *this;
  std::vector<Vec3> corners;
  for (int corner = 0; corner < 8; ++corner)
    corners.push_back(transform.point(
        {corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y, corner & 4 ? max.z : min.z}));
  return around(corners);
}

Extent Extent::common(const Extent& other) const {
  const Vec3 low = glm::max(min, other.min);
  return {low, glm::max(glm::min(max, other.max), low)};
}

Extent Extent::joined(const Extent& other) const {
  return {glm::min(min, other.min), glm::max(max, other.max)};
}

} // namespace celltrace
