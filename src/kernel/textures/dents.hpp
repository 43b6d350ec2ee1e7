// The dents pattern: the cube of smooth noise. Kernel dialect.
#pragma once

#include "kernel/textures/noise.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

struct DentsPattern : NoisePattern {
  static constexpr const char* kName = "dents";

  static constexpr bool kDisturbs = true;

  template <class S, class Source>
  [[gnu::always_inline]] static typename S::F value(const V3<S>& p, const PatternRecord&,
                                                    const Source& source) {
    const typename S::F noise = source.value(p);
    return noise * noise * noise;
  }
  template <class S> [[gnu::always_inline]] static V3<S> disturbance(const V3<S>& p, const PatternRecord& r) {
    return noise::vector<S>(p) * value<S>(p, r, noise::LatticeNoise<S>{r});
  }
};

} // namespace celltrace::kernel
