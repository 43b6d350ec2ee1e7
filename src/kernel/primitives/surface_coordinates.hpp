// Surface coordinates that several shapes have. Kernel dialect.
#pragma once

#include "kernel/angles.hpp"
#include "kernel/primitives/shape_traits.hpp"

namespace celltrace::kernel {

/// An angle in turns from 0 up to 1.
template <class S>
[[gnu::always_inline]] inline typename S::F whole_turns(const typename S::F& y, const typename S::F& x) {
  const typename S::F turns = turns_inline<S>(y, x);
  return turns - S::floor(turns);
}

/// Around the y axis, and from pole to pole.
template <class S>
[[gnu::always_inline]] inline void map_sphere(const V3<S>& p, typename S::F& u, typename S::F& v) {
  using F = typename S::F;
  u = whole_turns<S>(p.z, p.x);
  v = F(0.5f) + F(2.0f) * turns_inline<S>(p.y, S::sqrt(p.x * p.x + p.z * p.z));
}

} // namespace celltrace::kernel
