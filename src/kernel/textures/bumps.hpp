// Smooth noise, which as a normal disturbs in each coordinate by itself. Kernel dialect.
#pragma once

#include "kernel/textures/bozo.hpp"

namespace celltrace::kernel {

struct BumpsPattern : BozoPattern {
  static constexpr const char* kName = "bumps";
  static constexpr bool kDisturbs = true;

  /// What is added to a unit normal, in the pattern's space.
  template <class S> static V3<S> disturbance(const V3<S>& p, const PatternRecord&) {
    return noise::vector<S>(p);
  }
};

} // namespace celltrace::kernel
