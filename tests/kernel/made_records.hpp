// Records of the scene image as tests want them.
#pragma once

#include "lanes.hpp"
#include "records/object.hpp"

#include <cstdint>
#include <vector>

namespace celltrace::test {

inline kernel::ObjectRecord record_of(kernel::ObjectKind kind, const std::vector<double>& geometry) {
  kernel::ObjectRecord object{};
  object.kind_and_flags = static_cast<std::uint32_t>(kind);
  for (std::size_t i = 0; i < geometry.size(); ++i)
    object.geometry[i] = static_cast<float>(geometry[i]);
  return object;
}
inline kernel::ObjectRecord sphere(const Vec3& centre, double radius) {
  return record_of(kernel::ObjectKind::sphere, {centre.x, centre.y, centre.z, radius});
}
inline kernel::ObjectRecord triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return record_of(kernel::ObjectKind::triangle, {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z});
}

/// A box in all four places of a node.
inline void put_box(float (&box)[6][4], const Vec3& min, const Vec3& max) {
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 4; ++i) {
      box[2 * axis][i] = static_cast<float>(min[axis]);
      box[2 * axis + 1][i] = static_cast<float>(max[axis]);
    }
}

} // namespace celltrace::test
