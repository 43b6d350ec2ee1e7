// The axis-aligned bounding box, AABB. Kernel dialect.
#pragma once

#include "kernel/scalar.hpp"

namespace celltrace::kernel {

struct Aabb {
  float min[3];
  float max[3];
};

/// Returns the smallest box around both boxes.
inline Aabb united(const Aabb& a, const Aabb& b) {
  Aabb both;
  for (int i = 0; i < 3; ++i) {
    both.min[i] = smaller(a.min[i], b.min[i]);
    both.max[i] = larger(a.max[i], b.max[i]);
  }
  return both;
}
/// Returns the common part of both boxes; if there is none, its minimum is beyond its maximum.
inline Aabb intersected(const Aabb& a, const Aabb& b) {
  Aabb both;
  for (int i = 0; i < 3; ++i) {
    both.min[i] = larger(a.min[i], b.min[i]);
    both.max[i] = smaller(a.max[i], b.max[i]);
  }
  return both;
}

} // namespace celltrace::kernel
