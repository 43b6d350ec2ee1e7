// Waves that spread from points around the origin. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/random_tables.hpp"

namespace celltrace::kernel {

/// The common base of ripples and waves. A pattern defines height(), the height of a wave at a distance from
/// its source, and kStrength, the weight of waves. The parameter is the number of waves.
template <class Pattern> struct RunningWaves : RarePattern {
  static constexpr bool kDisturbs = true;

  template <class Spu>
  [[gnu::always_inline]] static typename Spu::rare_simd::F
  value(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    F sum(0.0f);
    for_each_height<Spu>(scene, p, r, [&](const V3<S>&, const F&, const F& height) { sum = sum + height; });
    return F(0.5f) + sum * F(Pattern::kStrength / r.parameter[0]);
  }
  template <class Spu>
  [[gnu::always_inline]] static V3<typename Spu::rare_simd>
  disturbance(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    V3<S> sum = {F(0.0f), F(0.0f), F(0.0f)};
    for_each_height<Spu>(scene, p, r, [&](const V3<S>& from, const F& distance, const F& height) {
      sum = sum + from * (height / distance);
    });
    return sum * F(1.0f / r.parameter[0]);
  }

protected:
  /// Returns the sine of a wave. As in POV-Ray, frequency and phase apply to the waves, and to the pattern's
  /// values as with any pattern.
  template <class S>
  [[gnu::always_inline]] static typename S::F sine(const typename S::F& distance, float frequency,
                                                   const PatternRecord& r) {
    using F = typename S::F;
    const F turns = distance * F(frequency) + F(r.phase);
    return sine_of_turns<S>(turns - S::floor(turns));
  }

private:
  /// Calls `visit(from, distance, height)` for each wave; `from` points from its source to the points.
  template <class Spu, class Visit>
  [[gnu::always_inline]] static void for_each_height(SceneAccess<Spu>& scene,
                                                     const V3<typename Spu::rare_simd>& p,
                                                     const PatternRecord& r, Visit visit) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    const uint32_t count = static_cast<uint32_t>(r.parameter[0]);
    for (uint32_t i = 0; i < count; ++i) {
      Kept<Spu, WaveRecord> wave =
          *scene.template pattern_table<WaveRecord>(r.table + i * static_cast<uint32_t>(sizeof(WaveRecord)));
      const V3<S> from = p - splat3<S>(wave.source);
      const F length = S::sqrt(dot<S>(from, from));
      const F distance = S::select(length > F(0.0f), length, F(1.0f));
      visit(from, distance, Pattern::template height<S>(wave, distance, r));
    }
  }
};

} // namespace celltrace::kernel
