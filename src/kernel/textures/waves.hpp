// Waves of different lengths that run from points around the origin into each other. Kernel dialect.
#pragma once

#include "kernel/textures/ripples.hpp"

namespace celltrace::kernel {

struct WavesPattern : RarePattern {
  static constexpr const char* kName = "waves";
  static constexpr bool kDisturbs = true;

  template <class Spu>
  [[gnu::always_inline]] static typename Spu::rare_simd::F
  value(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    F sum(0.0f);
    for_each_wave<Spu>(scene, p, r, [&](const WaveRecord& wave, const V3<S>&, const F& distance) {
      sum = sum + height<S>(wave, distance, r);
    });
    return F(0.5f) + sum * F(0.2f / r.parameter[0]);
  }
  template <class Spu>
  [[gnu::always_inline]] static V3<typename Spu::rare_simd>
  disturbance(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    V3<S> sum = {F(0.0f), F(0.0f), F(0.0f)};
    for_each_wave<Spu>(scene, p, r, [&](const WaveRecord& wave, const V3<S>& from, const F& distance) {
      sum = sum + from * (height<S>(wave, distance, r) / distance);
    });
    return sum * F(1.0f / r.parameter[0]);
  }

private:
  template <class S>
  [[gnu::always_inline]] static typename S::F height(const WaveRecord& wave, const typename S::F& distance,
                                                     const PatternRecord& r) {
    using F = typename S::F;
    return RipplesPattern::height<S>(distance * F(r.frequency * wave.frequency) + F(r.phase)) *
           F(1.0f / wave.frequency);
  }
};

} // namespace celltrace::kernel
