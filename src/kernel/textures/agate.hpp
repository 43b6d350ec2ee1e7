// The agate pattern: bands that noise bends. Kernel dialect.
#pragma once

#include "kernel/textures/noise.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

struct AgatePattern : NoisePattern {
  static constexpr const char* kName = "agate";

  /// Returns the value. The parameter is the strength of the turbulence.
  template <class S, class Source>
  [[gnu::always_inline]] static typename S::F value(const V3<S>& p, const PatternRecord& r,
                                                    const Source& source) {
    using F = typename S::F;
    const F turbulence = source.turbulence_value(p, r.turbulence);
    const F turns = turbulence * F(1.3f * r.parameter[0]) + p.z * F(1.1f);
    const F wave = (sine_of_turns<S>(turns - S::floor(turns)) + F(1.0f)) * F(0.5f);
    return pow<S>(wave, F(0.77f));
  }
};

} // namespace celltrace::kernel
