// Veins across x, which turbulence bends. Kernel dialect.
#pragma once

#include "kernel/textures/noise.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

struct MarblePattern : NoisePattern {
  static constexpr const char* kName = "marble";

  template <class S, class Source>
  [[gnu::always_inline]] static typename S::F value(const V3<S>& p, const PatternRecord& r,
                                                    const Source& source) {
    const float amount = r.turbulence.amount[0];
    if (amount == 0.0f) return p.x;
    const typename S::F turbulence = source.turbulence_value(p, r.turbulence);
    return p.x + turbulence * typename S::F(amount);
  }
};

} // namespace celltrace::kernel
