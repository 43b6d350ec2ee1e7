// The axis-aligned bounding box, AABB. Kernel dialect.
#pragma once

#include "kernel/scalar.hpp"

namespace celltrace::kernel {

struct Aabb {
  float min[3];
  float max[3];
};

/// The smallest box around both.
inline Aabb united(const Aabb& a, const Aabb& b) {
  Aabb both;
  for (int i = 0; i < 3; ++i) {
    both.min[i] = smaller(a.min[i], b.min[i]);
    both.max[i] = larger(a.max[i], b.max[i]);
  }
  return both;
}
/// What lies in both: a box whose minimum is beyond its maximum if nothing does.
inline Aabb intersected(const Aabb& a, const Aabb& b) {
  Aabb both;
  for (int i = 0; i < 3; ++i) {
    both.min[i] = larger(a.min[i], b.min[i]);
    both.max[i] = smaller(a.max[i], b.max[i]);
  }
  return both;
}

} // namespace celltrace::kernel
