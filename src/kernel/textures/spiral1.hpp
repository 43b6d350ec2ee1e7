// The spiral1 pattern: arms that wind around the z axis. Kernel dialect.
#pragma once

#include "kernel/angles.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct Spiral1Pattern : ShiftedPattern {
  static constexpr const char* kName = "spiral1";

  /// Returns the value. The parameter is the number of arms.
  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord& r) {
    return p.z + S::sqrt(p.x * p.x + p.y * p.y) + wound<S>(p, r);
  }

  template <class S> static typename S::F wound(const V3<S>& p, const PatternRecord& r) {
    using F = typename S::F;
    const F turns = turns_of<S>(p.y, p.x) + F(0.25f); // 0 at -y
    return (turns - S::floor(turns)) * F(r.parameter[0]);
  }
};

} // namespace celltrace::kernel
