// The bounding boxes that POV-Ray keeps for objects, and that the scene language can query.
#pragma once

#include "celltrace/transform.hpp"

#include <vector>

namespace celltrace {

/// A bounding box, which need not be tight. Infinite bounds are 1e10 in all directions.
struct Extent {
  Vec3 min{0, 0, 0}, max{0, 0, 0};

  static Extent everywhere();
  /// Returns the box around points; there must be at least one point.
  static Extent around(const std::vector<Vec3>& points);

  bool is_everywhere() const;
  double volume() const;
  Extent moved(const Transform& transform) const;
  /// Returns the intersection of both boxes; an empty box if they have no point in common.
  Extent common(const Extent& other) const;
  /// Returns a box around both boxes.
  Extent joined(const Extent& other) const;
};

} // namespace celltrace
