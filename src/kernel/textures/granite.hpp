// The granite pattern: six octaves of noise with creases. Kernel dialect.
#pragma once

#include "kernel/textures/noise.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

struct GranitePattern : NoisePattern {
  static constexpr const char* kName = "granite";

  template <class S, class Source>
  [[gnu::always_inline]] static typename S::F value(const V3<S>& p, const PatternRecord&,
                                                    const Source& source) {
    using F = typename S::F;
    F sum(0.0f);
    float scale = 4.0f, strength = 1.0f;
    for (uint32_t octave = 0; octave < 6; ++octave, scale *= 2.0f, strength *= 0.5f) {
      const F noise = source.spread_value(p * F(scale));
      sum = sum + S::abs(F(0.5f) - noise) * F(strength);
    }
    return sum;
  }
};

} // namespace celltrace::kernel
