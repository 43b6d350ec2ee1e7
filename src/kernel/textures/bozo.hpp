// Smooth noise. Kernel dialect.
#pragma once

#include "kernel/records.hpp"
#include "kernel/textures/noise.hpp"

namespace celltrace::kernel {

struct BozoPattern {
  static constexpr const char* kName = "bozo";
  static constexpr bool kIsList = false;
  static constexpr bool kNeedsNoise = true;
  static constexpr bool kDisturbs = false;

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord& r) {
    return noise::value<S>(p, (r.kind_and_flags & pattern_flag::first_generator) != 0);
  }
};

} // namespace celltrace::kernel
