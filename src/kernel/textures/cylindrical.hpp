// The cylindrical pattern: from 1 on the y axis to 0 on the unit cylinder around it. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct CylindricalPattern : BlendPattern {
  static constexpr const char* kName = "cylindrical";

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    return S::max(F(1.0f) - S::sqrt(p.x * p.x + p.z * p.z), F(0.0f));
  }
};

} // namespace celltrace::kernel
