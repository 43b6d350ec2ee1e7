// Waves that run from points around the origin into each other. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

/// Calls `visit(wave, from, distance)` for each of a pattern's waves: its record, and the way from its source
/// to the points. The pattern's parameter is their number.
template <class Spu, class Visit>
[[gnu::always_inline]] inline void for_each_wave(SceneAccess<Spu>& scene,
                                                 const V3<typename Spu::rare_simd>& p, const PatternRecord& r,
                                                 Visit visit) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  const uint32_t count = static_cast<uint32_t>(r.parameter[0]);
  for (uint32_t i = 0; i < count; ++i) {
    const WaveRecord wave =
        *scene.template pattern_table<WaveRecord>(r.table + i * static_cast<uint32_t>(sizeof(WaveRecord)));
    const V3<S> from = p - splat3<S>(wave.source);
    const F distance = S::sqrt(dot<S>(from, from));
    visit(wave, from, S::select(distance > F(0.0f), distance, F(1.0f)));
  }
}

struct RipplesPattern : RarePattern {
  static constexpr const char* kName = "ripples";
  static constexpr bool kDisturbs = true;

  /// As in POV-Ray, frequency and phase are those of the waves, and the common ones besides.
  template <class Spu>
  [[gnu::always_inline]] static typename Spu::rare_simd::F
  value(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    F sum(0.0f);
    for_each_wave<Spu>(scene, p, r, [&](const WaveRecord&, const V3<S>&, const F& distance) {
      sum = sum + height<S>(distance * F(r.frequency) + F(r.phase));
    });
    return F(0.5f) + sum * F(0.5f / r.parameter[0]);
  }
  template <class Spu>
  [[gnu::always_inline]] static V3<typename Spu::rare_simd>
  disturbance(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    V3<S> sum = {F(0.0f), F(0.0f), F(0.0f)};
    for_each_wave<Spu>(scene, p, r, [&](const WaveRecord&, const V3<S>& from, const F& distance) {
      sum = sum + from * (height<S>(distance * F(r.frequency) + F(r.phase)) / distance);
    });
    return sum * F(1.0f / r.parameter[0]);
  }

  template <class S> [[gnu::always_inline]] static typename S::F height(const typename S::F& turns) {
    return sine_of_turns<S>(turns - S::floor(turns));
  }
};

} // namespace celltrace::kernel
