// Tests whether the numbers of vectors and transformations are finite: scenes' scripts divide by zero.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>

#include "celltrace/transform.hpp"

namespace celltrace::pov {

inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool is_finite(const Transform& transform) {
  return std::all_of(std::begin(transform.rows), std::end(transform.rows),
                     [](const Vec3& row) { return is_finite(row); });
}

} // namespace celltrace::pov
