// Shells around the origin, one unit apart. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/records.hpp"

namespace celltrace::kernel {

struct OnionPattern {
  static constexpr const char* kName = "onion";
  static constexpr bool kIsList = false;
  static constexpr bool kNeedsNoise = false;
  static constexpr bool kDisturbs = false;

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    const typename S::F distance = S::sqrt(dot<S>(p, p));
    return distance - whole_below<S>(distance);
  }
};

} // namespace celltrace::kernel
