// Bands that noise bends. Kernel dialect.
#pragma once

#include "kernel/textures/noise.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

struct AgatePattern : NoisePattern {
  static constexpr const char* kName = "agate";

  /// Its parameter: by how much.
  template <class S>
  [[gnu::always_inline]] static typename S::F value(const V3<S>& p, const PatternRecord& r) {
    using F = typename S::F;
    const F turns =
        noise::turbulence_value<S>(p, r.turbulence, has_first_generator(r)) * F(1.3f * r.parameter[0]) +
        p.z * F(1.1f);
    const F wave = (sine_of_turns<S>(turns - whole_below<S>(turns)) + F(1.0f)) * F(0.5f);
    return pow<S>(wave, F(0.77f));
  }
};

} // namespace celltrace::kernel
