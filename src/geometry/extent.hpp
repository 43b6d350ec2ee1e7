// The boxes that POV-Ray keeps around objects, as scenes ask for them.
#pragma once

#include "celltrace/transform.hpp"

#include <vector>

namespace celltrace {

/// Not always the tightest box: 1e10 to all sides where there is none.
struct Extent {
  Vec3 min{0, 0, 0}, max{0, 0, 0};

  static Extent everywhere();
  /// At least one point.
  static Extent around(const std::vector<Vec3>& points);

  bool is_everywhere() const;
  double volume() const;
  /// Around the box as it is then.
  Extent moved(const Transform& transform) const;
  /// What is in both, or nothing wide where nothing is.
  Extent common(const Extent& other) const;
  /// Around both.
  Extent joined(const Extent& other) const;
};

} // namespace celltrace
