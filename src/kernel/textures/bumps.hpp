// The bumps pattern: smooth noise. As a normal the pattern disturbs each coordinate separately. Kernel
// dialect.
#pragma once

#include "kernel/textures/bozo.hpp"

namespace celltrace::kernel {

struct BumpsPattern : BozoPattern {
  static constexpr const char* kName = "bumps";
  static constexpr bool kDisturbs = true;

  /// Returns the vector that is added to a unit normal, in the pattern's space.
  template <class S> [[gnu::always_inline]] static V3<S> disturbance(const V3<S>& p, const PatternRecord&) {
    return noise::vector<S>(p);
  }
};

} // namespace celltrace::kernel
