// The wrinkles pattern: ten octaves of noise. Kernel dialect.
#pragma once

#include "kernel/textures/noise.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

struct WrinklesPattern : NoisePattern {
  static constexpr const char* kName = "wrinkles";

  static constexpr bool kDisturbs = true;

  template <class S, class Source>
  [[gnu::always_inline]] static typename S::F value(const V3<S>& p, const PatternRecord&,
                                                    const Source& source) {
    using F = typename S::F;
    F sum(0.0f);
    float scale = 1.0f, strength = 0.5f;
    for (uint32_t octave = 0; octave < 10; ++octave, scale *= 2.0f, strength *= 0.5f) {
      const F noise = source.spread_value(p * F(scale));
      sum = sum + noise * F(strength);
    }
    return sum;
  }
  template <class S> [[gnu::always_inline]] static V3<S> disturbance(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    V3<S> sum = {F(0.0f), F(0.0f), F(0.0f)};
    float scale = 1.0f, strength = 1.0f;
    for (uint32_t octave = 0; octave < 10; ++octave, scale *= 2.0f, strength *= 0.5f) {
      const V3<S> noise = noise::vector<S>(p * F(scale));
      sum = sum + V3<S>{S::abs(noise.x), S::abs(noise.y), S::abs(noise.z)} * F(strength);
    }
    return sum;
  }
};

} // namespace celltrace::kernel
