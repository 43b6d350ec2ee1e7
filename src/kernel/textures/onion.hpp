// The onion pattern: shells around the origin, one unit apart. Kernel dialect.
#pragma once

#include "kernel/textures/lattice.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct OnionPattern : BlendPattern {
  static constexpr const char* kName = "onion";

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    const F distance = snap<S>(S::sqrt(dot<S>(p, p)));
    return distance - S::floor(distance);
  }
};

} // namespace celltrace::kernel
