// The value of a pattern at points, a part of a packet's lanes at a time. Kernel dialect.
//
// Patterns have two code modules: those of noise, which brings its tables along, and the others, but for few
// whose code is always there.
#pragma once

#include "kernel/modules.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/list.hpp"
#include "kernel/textures/wave.hpp"

namespace celltrace::kernel {

/// Who asks patterns. Each has a code module with its own copies of what asks them.
enum class TextureStage : uint32_t { colours, normals };

/// The values of the patterns whose code is in one place, waves included.
template <PatternCode kCode, class S>
[[gnu::always_inline]] inline typename S::F value_of(const PatternRecord& r, const V3<S>& p) {
  typename S::F value(0.0f);
  Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
    using Pattern = decltype(pattern);
    if constexpr (Pattern::kCode == kCode) value = Pattern::template value<S>(p, r);
  });
  return wave_of<S>(r, value);
}

namespace module_patterns {

template <class Spu>
[[gnu::noinline]] typename Spu::rare_simd::F value(Spu& spu, const PatternRecord& r,
                                                   const V3<typename Spu::rare_simd>& p) {
  spu.run_in_module(modules::kPatterns);
  return value_of<PatternCode::plain>(r, p);
}

} // namespace module_patterns

namespace module_noise {

template <class Spu>
[[gnu::noinline]] typename Spu::rare_simd::F value(Spu& spu, const PatternRecord& r,
                                                   const V3<typename Spu::rare_simd>& p) {
  spu.run_in_module(modules::kNoise);
  return value_of<PatternCode::noise>(r, p);
}

template <class Spu>
[[gnu::noinline]] V3<typename Spu::rare_simd> displaced(Spu& spu, const TurbulenceWords& t,
                                                        const V3<typename Spu::rare_simd>& p) {
  using S = typename Spu::rare_simd;
  spu.run_in_module(modules::kNoise);
  return p + noise::turbulence<S>(p, t.octaves, t.lambda, t.omega) * splat3<S>(t.amount);
}

/// What a pattern of which disturbs() is true adds to a normal, in its own space.
template <class Spu>
[[gnu::noinline]] V3<typename Spu::rare_simd> disturbance(Spu& spu, const PatternRecord& r,
                                                          const V3<typename Spu::rare_simd>& p) {
  using S = typename Spu::rare_simd;
  spu.run_in_module(modules::kNoise);
  const typename S::F zero(0.0f);
  V3<S> added = {zero, zero, zero};
  Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
    using Pattern = decltype(pattern);
    if constexpr (Pattern::kDisturbs) added = Pattern::template disturbance<S>(p, r);
  });
  return added;
}

} // namespace module_noise

/// Points in the space of a pattern.
template <TextureStage kStage, class Spu>
[[gnu::noinline]] V3<typename Spu::rare_simd>
to_pattern_space(SceneAccess<Spu>& scene, const PatternRecord& r, const V3<typename Spu::rare_simd>& point) {
  using S = typename Spu::rare_simd;
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
template <class Spu>
typename Spu::rare_simd::F pattern_value(Spu& spu, const PatternRecord& r,
                                         const V3<typename Spu::rare_simd>& p) {
  spu.compute(scalar_work::kPattern);
  switch (Patterns::kCode[r.kind_and_flags & pattern_flag::kind_mask]) {
  case PatternCode::resident:
    break;
  case PatternCode::plain:
    spu.enter_module(modules::kPatterns);
    return module_patterns::value(spu, r, p);
  case PatternCode::noise:
    spu.enter_module(modules::kNoise);
    return module_noise::value(spu, r, p);
  }
  return value_of<PatternCode::resident>(r, p);
}

} // namespace celltrace::kernel
