#include "scene_image/box_bounds.hpp"

#include "kernel/primitives/list.hpp"
#include "scene_image/csg_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace celltrace {

using namespace kernel;

namespace {

/// Returns the distance within which two faces count as coincident, because their places are rounded.
float rounding_at(float coordinate) {
  constexpr float kRounding = 2e-5f; // bounds are too large by up to a third of this
  return kRounding * (1.0f + std::abs(coordinate));
}

} // namespace

std::optional<Aabb> box_along_axes(const PlacedShape& shape) {
  constexpr float kMostTurned = 1e-9f;
  if (shape.is_empty || (shape.kind_and_flags & object_flag::kind_mask) != kPrimitiveKind<BoxPrimitive>)
    return {};
  for (int row = 0; row < 3; ++row) {
    const float* map = shape.geometry + 4 * row;
    const float x = std::abs(map[0]), y = std::abs(map[1]), z = std::abs(map[2]);
    const float most = std::max({x, y, z});
    const float others = most == x ? y + z : most == y ? x + z : x + y;
    if (!(others <= kMostTurned * most)) return {};
  }
  return shape.bounds();
}

Aabb left_by_box(const Aabb& box, const Aabb& within) {
  // `covers` requires some distance to the sides of `within`: if two faces coincide, either face may be seen.
  const auto covers = [&](int axis) {
    const float low = within.min[axis], high = within.max[axis];
    return box.min[axis] + rounding_at(low) <= low && box.max[axis] - rounding_at(high) >= high;
  };
  Aabb left = within;
  for (int axis = 0; axis < 3; ++axis) {
    if (!covers((axis + 1) % 3) || !covers((axis + 2) % 3)) continue;
    const float low = box.min[axis], high = box.max[axis];
    const bool has_low = low + rounding_at(low) <= left.min[axis];
    const bool has_high = high - rounding_at(high) >= left.max[axis];
    if (has_low) left.min[axis] = std::max(left.min[axis], high - slack_at(high));
    if (has_high) left.max[axis] = std::min(left.max[axis], low + slack_at(low));
  }
  return left;
}

Aabb bounds_of_faces(const Aabb& box, const Aabb& within) {
  Aabb all = kNowhere;
  Aabb padded = box;
  for (int axis = 0; axis < 3; ++axis) {
    padded.min[axis] -= slack_at(box.min[axis]);
    padded.max[axis] += slack_at(box.max[axis]);
  }
  for (int axis = 0; axis < 3; ++axis)
    for (const float at : {box.min[axis], box.max[axis]}) {
      Aabb face = padded;
      face.min[axis] = at - slack_at(at);
      face.max[axis] = at + slack_at(at);
      face = intersected(face, within);
      if (!is_empty(face)) all = united(all, face);
    }
  return all;
}

} // namespace celltrace
