// The planar pattern: from 1 on the xz plane to 0 at a distance of 1. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct PlanarPattern : BlendPattern {
  static constexpr const char* kName = "planar";

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    return S::max(F(1.0f) - S::abs(p.y), F(0.0f));
  }
};

} // namespace celltrace::kernel
