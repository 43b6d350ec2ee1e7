// The waves pattern: waves of different lengths that spread from points around the origin. Kernel dialect.
#pragma once

#include "kernel/textures/running_waves.hpp"

namespace celltrace::kernel {

struct WavesPattern : RunningWaves<WavesPattern> {
  static constexpr const char* kName = "waves";
  static constexpr float kStrength = 0.2f;

  template <class S>
  [[gnu::always_inline]] static typename S::F height(const WaveRecord& wave, const typename S::F& distance,
                                                     const PatternRecord& r) {
    return sine<S>(distance, r.frequency * wave.frequency, r) * typename S::F(1.0f / wave.frequency);
  }
};

} // namespace celltrace::kernel
