// The value of a pattern at sixteen points. Kernel dialect.
//
// Patterns have two code modules: those of noise, which brings its tables along, and all others.
#pragma once

#include "kernel/modules.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/list.hpp"
#include "kernel/textures/wave.hpp"

namespace celltrace::kernel {

namespace module_patterns {

template <class Spu>
[[gnu::noinline]] typename Spu::simd::F value(Spu& spu, const PatternRecord& r,
                                              const V3<typename Spu::simd>& p) {
  using F = typename Spu::simd::F;
  spu.run_in_module(modules::kPatterns);
  F v(0.0f);
  Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
    using Pattern = decltype(pattern);
    if constexpr (!Pattern::kNeedsNoise) v = Pattern::template value<typename Spu::simd>(p, r);
  });
  return v;
}

} // namespace module_patterns

namespace module_noise {

template <class Spu>
[[gnu::noinline]] typename Spu::simd::F value(Spu& spu, const PatternRecord& r,
                                              const V3<typename Spu::simd>& p) {
  using F = typename Spu::simd::F;
  spu.run_in_module(modules::kNoise);
  F v(0.0f);
  Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
    using Pattern = decltype(pattern);
    if constexpr (Pattern::kNeedsNoise) v = Pattern::template value<typename Spu::simd>(p, r);
  });
  return v;
}

template <class Spu>
[[gnu::noinline]] V3<typename Spu::simd> displaced(Spu& spu, const TurbulenceWords& t,
                                                   const V3<typename Spu::simd>& p) {
  spu.run_in_module(modules::kNoise);
  using S = typename Spu::simd;
  return p + noise::turbulence<S>(p, t.octaves, t.lambda, t.omega) * splat3<S>(t.amount);
}

/// What a pattern of which disturbs() is true adds to a normal, in its own space.
template <class Spu>
[[gnu::noinline]] V3<typename Spu::simd> disturbance(Spu& spu, const PatternRecord& r,
                                                     const V3<typename Spu::simd>& p) {
  using F = typename Spu::simd::F;
  spu.run_in_module(modules::kNoise);
  V3<typename Spu::simd> d = {F(0.0f), F(0.0f), F(0.0f)};
  Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
    using Pattern = decltype(pattern);
    if constexpr (Pattern::kDisturbs) d = Pattern::template disturbance<typename Spu::simd>(p, r);
  });
  return d;
}

} // namespace module_noise

/// Points in the space of a pattern.
template <TextureStage kStage, class Spu>
[[gnu::noinline]] V3<typename Spu::simd> to_pattern_space(SceneAccess<Spu>& scene, const PatternRecord& r,
                                                          const V3<typename Spu::simd>& point) {
  using S = typename Spu::simd;
  Spu& spu = scene.spu();
  V3<S> p = map_point<S>(r.to_space, point);
  for (uint32_t i = 0; i < r.step_count; ++i) {
    // A copy: the next read may replace the record.
    const SpaceStepRecord step =
        *scene.space_step(r.steps + i * static_cast<uint32_t>(sizeof(SpaceStepRecord)));
    spu.enter_module(modules::kNoise);
    p = map_point<S>(step.to_space, module_noise::displaced(spu, step.turbulence, p));
  }
  if ((r.kind_and_flags & pattern_flag::turbulent) != 0) {
    spu.enter_module(modules::kNoise);
    p = module_noise::displaced(spu, r.turbulence, p);
  }
  return p;
}

/// At points in the pattern's own space, wave included.
template <TextureStage kStage, class Spu>
typename Spu::simd::F pattern_value(Spu& spu, const PatternRecord& r, const V3<typename Spu::simd>& p) {
  spu.compute(scalar_work::kPattern);
  const bool needs_noise = Patterns::kNeedNoise[r.kind_and_flags & pattern_flag::kind_mask];
  spu.enter_module(needs_noise ? modules::kNoise : modules::kPatterns);
  const auto value = needs_noise ? module_noise::value(spu, r, p) : module_patterns::value(spu, r, p);
  return wave_of<typename Spu::simd, kStage>(r, value);
}

} // namespace celltrace::kernel
