// Queries about a mesh's vertices and single triangles.
#pragma once

#include "celltrace/scene.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include <glm/geometric.hpp>

namespace celltrace {

/// Returns the greatest magnitude of a coordinate; not finite if a coordinate is not finite. The loop goes
/// over words, so that it can be vectorised: the bits of magnitudes are ordered as the numbers are, with
/// infinity and NaN above all numbers.
inline float greatest_magnitude(std::span<const Vec3f> vectors) {
  static_assert(sizeof(Vec3f) == 3 * sizeof(std::int32_t));
  constexpr std::int32_t kMagnitude = 0x7FFFFFFF;
  const auto* const bytes = reinterpret_cast<const std::byte*>(vectors.data());
  std::int32_t greatest = 0;
  for (std::size_t i = 0; i < vectors.size_bytes(); i += sizeof greatest) {
    std::int32_t word = 0;
    std::memcpy(&word, bytes + i, sizeof word);
    greatest = std::max(greatest, word & kMagnitude);
  }
  return std::bit_cast<float>(greatest);
}

/// Returns whether a triangle has an area. Double precision decides; single precision is faster where it
/// leaves no doubt.
inline bool has_area(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f u = b - a;
  const Vec3f v = c - a;
  const float x[3] = {u.y * v.z, u.z * v.x, u.x * v.y};
  const float y[3] = {u.z * v.y, u.x * v.z, u.y * v.x};
  for (int i = 0; i < 3; ++i)
    if (std::abs(x[i] - y[i]) > 1e-6f * (std::abs(x[i]) + std::abs(y[i])) + 1e-30f) return true;
  const Vec3 area = glm::cross(Vec3(b) - Vec3(a), Vec3(c) - Vec3(a));
  return glm::dot(area, area) != 0;
}

inline bool same(const Index (&index)[3]) {
  return index[0] == index[1] && index[0] == index[2];
}

/// Returns whether a triangle's normals differ, so that it looks bent.
inline bool is_smooth(const Mesh::Triangle& triangle) {
  return triangle.normal[0] != kNoIndex && !same(triangle.normal);
}

/// Returns a normal of unit length; a normal without a direction becomes some unit vector.
inline Vec3 unit_normal(const Vec3f& normal) {
  const Vec3 n(normal);
  const double length = glm::length(n);
  return length > 0 ? n / length : Vec3(0, 0, 1);
}

/// Transforms unit normals of a mesh to the world by the inverse transpose, which is computed once. Results
/// do not have unit length, since a triangle's normals are interpolated in the mesh's own space.
class NormalTransform {
public:
  explicit NormalTransform(const Transform& transform)
      : columns_{transform.normal({1, 0, 0}), transform.normal({0, 1, 0}), transform.normal({0, 0, 1})},
        scale_(1 / std::max({glm::length(columns_[0]), glm::length(columns_[1]), glm::length(columns_[2])})) {
  }

  Vec3f operator()(const Vec3& unit) const {
    return Vec3f(scale_ * (unit.x * columns_[0] + unit.y * columns_[1] + unit.z * columns_[2]));
  }

private:
  Vec3 columns_[3];
  double scale_;
};

} // namespace celltrace
