// Surface coordinates of several shapes. Kernel dialect.
#pragma once

#include "kernel/angles.hpp"
#include "kernel/primitives/shape_traits.hpp"

namespace celltrace::kernel {

/// Returns an angle in turns, in [0, 1).
template <class S>
[[gnu::always_inline]] inline typename S::F whole_turns(const typename S::F& y, const typename S::F& x) {
  const typename S::F turns = turns_inline<S>(y, x);
  return turns - S::floor(turns);
}

/// Finds the coordinates on a sphere: around the y axis, and from pole to pole.
template <class S>
[[gnu::always_inline]] inline void map_sphere(const V3<S>& p, typename S::F& u, typename S::F& v) {
  using F = typename S::F;
  u = whole_turns<S>(p.z, p.x);
  v = F(0.5f) + F(2.0f) * turns_inline<S>(p.y, S::sqrt(p.x * p.x + p.z * p.z));
}

} // namespace celltrace::kernel
