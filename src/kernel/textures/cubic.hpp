// The cubic pattern: the side of a cube through which a point is seen from the origin. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct CubicPattern : ListPattern {
  static constexpr const char* kName = "cubic";

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    const F zero(0.0f);
    const auto side = [&](const F& x, float positive) {
      return S::select(x < zero, F(positive + 3), F(positive));
    };
    const F ax = S::abs(p.x), ay = S::abs(p.y), az = S::abs(p.z);
    const F of_y_or_z = S::select(ay >= az, side(p.y, 1), side(p.z, 2));
    return S::select((ax >= ay) & (ax >= az), side(p.x, 0), of_y_or_z);
  }
};

} // namespace celltrace::kernel
