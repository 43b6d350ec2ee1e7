// The spiral2 pattern: arms that wind around the z axis in both directions. Kernel dialect.
#pragma once

#include "kernel/textures/spiral1.hpp"

namespace celltrace::kernel {

struct Spiral2Pattern : ShiftedPattern {
  static constexpr const char* kName = "spiral2";

  /// Returns the value. The parameter is the number of arms.
  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord& r) {
    const typename S::F radius = S::sqrt(p.x * p.x + p.y * p.y);
    return triangle<S>(radius) + triangle<S>(p.z + radius + Spiral1Pattern::wound<S>(p, r));
  }

  template <class S> static typename S::F triangle(const typename S::F& x) {
    using F = typename S::F;
    const F part = x - S::floor(x);
    return S::min(part + part, F(2.0f) - part - part);
  }
};

} // namespace celltrace::kernel
