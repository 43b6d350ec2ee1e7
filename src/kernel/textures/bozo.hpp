// The bozo pattern: smooth noise. Kernel dialect.
#pragma once

#include "kernel/textures/noise.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

struct BozoPattern : NoisePattern {
  static constexpr const char* kName = "bozo";

  template <class S, class Source>
  [[gnu::always_inline]] static typename S::F value(const V3<S>& p, const PatternRecord&,
                                                    const Source& source) {
    return source.value(p);
  }
};

} // namespace celltrace::kernel
