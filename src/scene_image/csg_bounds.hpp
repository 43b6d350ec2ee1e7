// Helpers shared by the code that computes bounds of CSG parts.
#pragma once

#include "kernel/aabb.hpp"

#include <cmath>
#include <limits>

namespace celltrace {

/// The coordinate that stands for infinity in bounds.
inline constexpr float kInfinite = std::numeric_limits<float>::max();
inline constexpr kernel::Aabb kEverywhere = {{-kInfinite, -kInfinite, -kInfinite},
                                             {kInfinite, kInfinite, kInfinite}};
inline constexpr kernel::Aabb kNowhere = {{kInfinite, kInfinite, kInfinite},
                                          {-kInfinite, -kInfinite, -kInfinite}};

inline bool is_empty(const kernel::Aabb& box) {
  return box.min[0] > box.max[0] || box.min[1] > box.max[1] || box.min[2] > box.max[2];
}

inline bool is_bounded(const kernel::Aabb& box) {
  constexpr float kMost = 1e18f;
  for (int i = 0; i < 3; ++i)
    if (!(box.min[i] > -kMost && box.max[i] < kMost)) return false;
  return true;
}

/// Returns the distance by which bounds are wider than a face at this coordinate: more than the error of
/// single precision for objects that are not too far away.
inline float slack_at(float coordinate) {
  constexpr float kSlack = 1e-4f;
  return kSlack * (1.0f + std::abs(coordinate));
}

} // namespace celltrace
