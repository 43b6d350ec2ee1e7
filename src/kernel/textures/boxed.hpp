// The boxed pattern: from 1 at the origin to 0 at the sides of a cube. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct BoxedPattern : BlendPattern {
  static constexpr const char* kName = "boxed";

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    const F farthest = S::max(S::abs(p.x), S::max(S::abs(p.y), S::abs(p.z)));
    return S::max(F(1.0f) - farthest, F(0.0f));
  }
};

} // namespace celltrace::kernel
