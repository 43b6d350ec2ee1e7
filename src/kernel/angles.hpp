// Angles of points about an axis. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/math.hpp"

namespace celltrace::kernel {

/// Returns the angle of the point (x, y) from the x axis toward the y axis, in turns of -0.5 to 0.5; absolute
/// error below 1e-7 (Abramowitz and Stegun 4.4.49). The origin has angle 0.
template <class S>
[[gnu::always_inline]] inline typename S::F turns_inline(const typename S::F& y, const typename S::F& x) {
  using F = typename S::F;
  const F zero(0.0f);
  const F ax = S::abs(x), ay = S::abs(y);
  const auto steep = ay > ax;
  const F q = S::min(ax, ay) / S::max(S::max(ax, ay), F(1e-30f));
  const F s = q * q;
  const F series =
      F(1.0f) +
      s * (F(-0.3333314528f) +
           s * (F(0.1999355085f) +
                s * (F(-0.1420889944f) +
                     s * (F(0.1065626393f) +
                          s * (F(-0.0752896400f) +
                               s * (F(0.0429096138f) + s * (F(-0.0161657367f) + s * F(0.0028662257f))))))));
  const F small = q * series * F(0.159154943f);
  const F quadrant = S::select(steep, F(0.25f) - small, small);
  const F half = S::select(x < zero, F(0.5f) - quadrant, quadrant);
  return S::select(y < zero, -half, half);
}
/// Returns turns_inline(), compiled once as resident code, because patterns of two modules call it.
template <class S> CELLTRACE_ONE_COPY typename S::F turns_of(const typename S::F& y, const typename S::F& x) {
  return turns_inline<S>(y, x);
}

} // namespace celltrace::kernel
