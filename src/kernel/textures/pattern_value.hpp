// The value of a pattern at sixteen points. Kernel dialect.
//
// Patterns have two code modules: those of noise, which brings its tables along, and all others.
#pragma once

#include "kernel/modules.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/list.hpp"
#include "kernel/textures/wave.hpp"

namespace celltrace::kernel {

/// Who asks patterns. Each has a code module with its own copies of what asks them.
enum class TextureStage : uint32_t { colours, normals };

/// What `change` makes of vectors, so many lanes at a time as rare code takes.
template <class Spu, class Change>
[[gnu::always_inline]] inline V3<typename Spu::simd> map_parts(const V3<typename Spu::simd>& vectors,
                                                               Change change) {
  using R = typename Spu::rare_simd;
  VectorLanes lanes;
  lanes.template store<typename Spu::simd>(vectors);
  for_each_part<Spu>([&](uint32_t first) {
    lanes.template store_from<R>(first, change(lanes.template load_from<R>(first)));
  });
  return lanes.template load<typename Spu::simd>();
}

/// The values of the patterns with noise, or of the others, waves included.
template <bool kWithNoise, class Spu>
[[gnu::always_inline]] inline typename Spu::simd::F value_of(const PatternRecord& r,
                                                             const V3<typename Spu::simd>& p) {
  using R = typename Spu::rare_simd;
  VectorLanes at;
  at.template store<typename Spu::simd>(p);
  FloatLanes values;
  for_each_part<Spu>([&](uint32_t first) {
    const V3<R> point = at.template load_from<R>(first);
    typename R::F value(0.0f);
    Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
      using Pattern = decltype(pattern);
      if constexpr (Pattern::kNeedsNoise == kWithNoise) value = Pattern::template value<R>(point, r);
    });
    wave_of<R>(r, value).store(values.lane + first);
  });
  return Spu::simd::F::load(values.lane);
}

namespace module_patterns {

template <class Spu>
[[gnu::noinline]] typename Spu::simd::F value(Spu& spu, const PatternRecord& r,
                                              const V3<typename Spu::simd>& p) {
  spu.run_in_module(modules::kPatterns);
  return value_of<false, Spu>(r, p);
}

} // namespace module_patterns

namespace module_noise {

template <class Spu>
[[gnu::noinline]] typename Spu::simd::F value(Spu& spu, const PatternRecord& r,
                                              const V3<typename Spu::simd>& p) {
  spu.run_in_module(modules::kNoise);
  return value_of<true, Spu>(r, p);
}

template <class Spu>
[[gnu::noinline]] V3<typename Spu::simd> displaced(Spu& spu, const TurbulenceWords& t,
                                                   const V3<typename Spu::simd>& p) {
  using R = typename Spu::rare_simd;
  spu.run_in_module(modules::kNoise);
  return map_parts<Spu>(p, [&](const V3<R>& point) {
    return point + noise::turbulence<R>(point, t.octaves, t.lambda, t.omega) * splat3<R>(t.amount);
  });
}

/// What a pattern of which disturbs() is true adds to a normal, in its own space.
template <class Spu>
[[gnu::noinline]] V3<typename Spu::simd> disturbance(Spu& spu, const PatternRecord& r,
                                                     const V3<typename Spu::simd>& p) {
  using R = typename Spu::rare_simd;
  spu.run_in_module(modules::kNoise);
  return map_parts<Spu>(p, [&](const V3<R>& point) {
    const typename R::F zero(0.0f);
    V3<R> added = {zero, zero, zero};
    Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
      using Pattern = decltype(pattern);
      if constexpr (Pattern::kDisturbs) added = Pattern::template disturbance<R>(point, r);
    });
    return added;
  });
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
template <class Spu>
typename Spu::simd::F pattern_value(Spu& spu, const PatternRecord& r, const V3<typename Spu::simd>& p) {
  spu.compute(scalar_work::kPattern);
  const bool needs_noise = Patterns::kNeedNoise[r.kind_and_flags & pattern_flag::kind_mask];
  spu.enter_module(needs_noise ? modules::kNoise : modules::kPatterns);
  return needs_noise ? module_noise::value(spu, r, p) : module_patterns::value(spu, r, p);
}

} // namespace celltrace::kernel
