// The spherical pattern: from 1 at the origin to 0 on the unit sphere. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct SphericalPattern : BlendPattern {
  static constexpr const char* kName = "spherical";

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    return S::max(F(1.0f) - S::sqrt(dot<S>(p, p)), F(0.0f));
  }
};

} // namespace celltrace::kernel
