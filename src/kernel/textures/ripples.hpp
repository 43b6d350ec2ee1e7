// The ripples pattern: waves of equal length that spread from points around the origin. Kernel dialect.
#pragma once

#include "kernel/textures/running_waves.hpp"
#include "records/random_tables.hpp"

namespace celltrace::kernel {

struct RipplesPattern : RunningWaves<RipplesPattern> {
  static constexpr const char* kName = "ripples";
  static constexpr float kStrength = 0.5f;

  template <class S>
  [[gnu::always_inline]] static typename S::F height(const WaveRecord&, const typename S::F& distance,
                                                     const PatternRecord& r) {
    return sine<S>(distance, r.frequency, r);
  }
};

} // namespace celltrace::kernel
