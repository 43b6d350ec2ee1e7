// Evaluation of a pattern at points, for a part of a packet's lanes at a time. Kernel dialect.
//
// The code of patterns is in modules: one for noise, with its tables, one for rare patterns, many of which
// read tables of the scene image, and one for other patterns. A few patterns have resident code.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/parts.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/gradient_noise.hpp"
#include "kernel/textures/list.hpp"
#include "kernel/textures/pattern_points.hpp"
#include "kernel/textures/pigment_lanes.hpp"
#include "kernel/textures/warps.hpp"
#include "kernel/textures/wave.hpp"

namespace celltrace::kernel {

/// A stage that evaluates patterns: pigments, normals, and the maps of textures at hits. Each has a code
/// module with its own copies of the code that evaluates them.
enum class TextureStage : uint32_t { colours, normals, maps };

/// Returns the values of a pattern whose code is in the location `kCode`, with its wave form.
template <PatternCode kCode, class S>
[[gnu::always_inline]] inline typename S::F value_of(const PatternRecord& r, const V3<S>& p) {
  typename S::F value(0.0f);
  Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
    using Pattern = decltype(pattern);
    if constexpr (Pattern::kCode == kCode) {
      if constexpr (kCode == PatternCode::noise)
        value = Pattern::template value<S>(p, r, noise::LatticeNoise<S>{r});
      else
        value = Pattern::template value<S>(p, r);
    }
  });
  return wave_of(r) == PatternWave::none ? value : in_wave_form<S>(r, value);
}

/// Moves points to where a ShiftedPattern is evaluated.
template <class S, class Source>
[[gnu::always_inline]] inline void shift_points(V3<S>& p, const PatternRecord& r, const Source& source) {
  using F = typename S::F;
  const F turbulence = source.turbulence_value(p, r.turbulence);
  const bool is_marble = (r.kind_and_flags & pattern_flag::kind_mask) == kPatternKind<MarblePattern>;
  F& coordinate = is_marble ? p.x : p.z;
  coordinate = coordinate + turbulence * F(r.turbulence.amount[0]);
}

namespace module_patterns {

template <class Spu>
CELLTRACE_ONE_COPY typename Spu::rare_simd::F value(Spu& spu, const PatternRecord& r,
                                                    const V3<typename Spu::rare_simd>& p) {
  spu.run_in_module(modules::kPatterns);
  return value_of<PatternCode::plain>(r, p);
}

} // namespace module_patterns

namespace module_noise {

template <class Spu>
CELLTRACE_ONE_COPY typename Spu::rare_simd::F value(Spu& spu, const PatternRecord& r,
                                                    const V3<typename Spu::rare_simd>& p) {
  spu.run_in_module(modules::kNoise);
  return value_of<PatternCode::noise>(r, p);
}

template <class Spu>
CELLTRACE_ONE_COPY V3<typename Spu::rare_simd> displaced(Spu& spu, const TurbulenceWords& t,
                                                         const V3<typename Spu::rare_simd>& p) {
  using S = typename Spu::rare_simd;
  spu.run_in_module(modules::kNoise);
  return p + noise::turbulence<S>(p, t.octaves, t.lambda, t.omega) * splat3<S>(t.amount);
}

/// Moves points by noise of generators 1 and 2.
template <class Spu>
CELLTRACE_ONE_COPY void shift(Spu& spu, const PatternRecord& r, V3<typename Spu::rare_simd>& p) {
  using S = typename Spu::rare_simd;
  spu.run_in_module(modules::kNoise);
  shift_points<S>(p, r, noise::LatticeNoise<S>{r});
}

/// Returns the vector that a pattern with disturbs() adds to a normal, in its own space.
template <class Spu>
CELLTRACE_ONE_COPY V3<typename Spu::rare_simd> disturbance(Spu& spu, const PatternRecord& r,
                                                           const V3<typename Spu::rare_simd>& p) {
  using S = typename Spu::rare_simd;
  spu.run_in_module(modules::kNoise);
  const typename S::F zero(0.0f);
  V3<S> added = {zero, zero, zero};
  Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
    using Pattern = decltype(pattern);
    if constexpr (Pattern::kDisturbs && Pattern::kCode != PatternCode::rare)
      added = Pattern::template disturbance<S>(p, r);
  });
  return added;
}

} // namespace module_noise

namespace module_warps {

template <class Spu>
CELLTRACE_ONE_COPY V3<typename Spu::rare_simd> bent(SceneAccess<Spu>& scene, const SpaceStepRecord& step,
                                                    const V3<typename Spu::rare_simd>& p) {
  using S = typename Spu::rare_simd;
  scene.spu().run_in_module(modules::kWarps);
  const auto kind = static_cast<WarpKind>(step.kind_and_flags & warp_flag::kind_mask);
  switch (kind) {
  case WarpKind::repeat:
    return warps::repeated<S>(step, p);
  case WarpKind::black_hole:
    return warps::attracted(scene, step, p);
  default:
    return warps::unwrapped<S>(kind, step, p);
  }
}

} // namespace module_warps

namespace module_functions {

template <class Spu>
CELLTRACE_ONE_COPY typename Spu::rare_simd::F value(SceneAccess<Spu>& scene, const PatternRecord& r,
                                                    const V3<typename Spu::rare_simd>& p) {
  using S = typename Spu::rare_simd;
  scene.spu().run_in_module(modules::kFunctions);
  const typename S::F value = FunctionPattern::value<Spu>(scene, p, r);
  return wave_of(r) == PatternWave::none ? value : in_wave_form<S>(r, value);
}

} // namespace module_functions

namespace module_rare {

/// Returns the feature points that are nearest to points.
template <class Spu>
CELLTRACE_ONE_COPY V3<typename Spu::rare_simd>
nearest_feature(SceneAccess<Spu>& scene, const PatternRecord& r, const V3<typename Spu::rare_simd>& p) {
  scene.spu().run_in_module(modules::kRarePatterns);
  return CracklePattern::nearest_of<Spu>(scene, p, r, {0, true}).point;
}

/// Returns the values of rare patterns, and of noise patterns with generator 3.
template <class Spu>
CELLTRACE_ONE_COPY typename Spu::rare_simd::F value(SceneAccess<Spu>& scene, const PatternRecord& r,
                                                    const PatternPoints<typename Spu::rare_simd>& points) {
  using S = typename Spu::rare_simd;
  scene.spu().run_in_module(modules::kRarePatterns);
  const V3<S>& p = points.at;
  const noise::GradientNoise<Spu> source(scene, r.table);
  V3<S> q = p;
  if ((r.kind_and_flags & pattern_flag::at_features) != 0) q = nearest_feature(scene, r, p);
  if ((r.kind_and_flags & pattern_flag::shifted) != 0) shift_points<S>(q, r, source);
  typename S::F value(0.0f);
  Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
    using Pattern = decltype(pattern);
    if constexpr (Pattern::kReadsSurface)
      value = Pattern::template value<Spu>(scene, points, r);
    else if constexpr (Pattern::kCode == PatternCode::rare && !Pattern::kIsColour)
      value = Pattern::template value<Spu>(scene, p, r);
    if constexpr (Pattern::kIsShifted)
      value = Pattern::template value<S>(q, r);
    else if constexpr (Pattern::kReadsNoise)
      value = Pattern::template value<S>(q, r, source);
  });
  return wave_of(r) == PatternWave::none ? value : in_wave_form<S>(r, value);
}

/// Sets the colours of a pattern with is_colour(); for other patterns it leaves them as they are.
template <class Spu>
CELLTRACE_ONE_COPY void colour(SceneAccess<Spu>& scene, const PatternRecord& r,
                               const PatternPoints<typename Spu::rare_simd>& points,
                               PigmentLanes<typename Spu::rare_simd>& pigment) {
  scene.spu().run_in_module(modules::kRarePatterns);
  Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
    using Pattern = decltype(pattern);
    if constexpr (Pattern::kIsColour) pigment = Pattern::template colour<Spu>(scene, points, r);
  });
}

/// Returns the vector that a rare pattern with disturbs() adds to a normal, in its own space.
template <class Spu>
CELLTRACE_ONE_COPY V3<typename Spu::rare_simd> disturbance(SceneAccess<Spu>& scene, const PatternRecord& r,
                                                           const V3<typename Spu::rare_simd>& p) {
  using S = typename Spu::rare_simd;
  scene.spu().run_in_module(modules::kRarePatterns);
  const typename S::F zero(0.0f);
  V3<S> added = {zero, zero, zero};
  Patterns::dispatch(r.kind_and_flags & pattern_flag::kind_mask, [&](auto pattern) {
    using Pattern = decltype(pattern);
    if constexpr (Pattern::kDisturbs && Pattern::kCode == PatternCode::rare)
      added = Pattern::template disturbance<Spu>(scene, p, r);
  });
  return added;
}

} // namespace module_rare

/// Maps the points of `lanes` to the space of a pattern. The results of other lanes are undefined.
template <TextureStage kStage, class Spu>
CELLTRACE_ONE_COPY PatternPoints<typename Spu::rare_simd>
to_pattern_space(SceneAccess<Spu>& scene, const PatternRecord& r,
                 const PatternPoints<typename Spu::rare_simd>& points, uint32_t lanes) {
  using S = typename Spu::rare_simd;
  Spu& spu = scene.spu();
  V3<S> p = points.at;
  // Skies have no surface.
  if ((r.kind_and_flags & pattern_flag::uv_mapping) != 0 && points.surface != nullptr)
    p = surface_coordinates(points);
  p = map_point<S>(r.to_space, p);
  move_idle_lanes<Spu>(p, lanes);
  for (uint32_t i = 0; i < r.step_count; ++i) {
    Kept<Spu, SpaceStepRecord> step =
        *scene.space_step(r.steps + i * static_cast<uint32_t>(sizeof(SpaceStepRecord)));
    if ((step.kind_and_flags & warp_flag::kind_mask) == static_cast<uint32_t>(WarpKind::turbulence)) {
      spu.enter_module(modules::kNoise);
      p = module_noise::displaced(spu, step.turbulence, p);
    } else {
      spu.enter_module(modules::kWarps);
      p = module_warps::bent(scene, step, p);
    }
    p = map_point<S>(step.to_space, p);
  }
  if ((r.kind_and_flags & pattern_flag::turbulent) != 0) {
    spu.enter_module(modules::kNoise);
    p = module_noise::displaced(spu, r.turbulence, p);
  }
  return {p, points.surface, points.first};
}

/// Returns the values at points in the pattern's own space, with its wave form. Has one resident copy.
template <class Spu>
typename Spu::rare_simd::F pattern_value(SceneAccess<Spu>& scene, const PatternRecord& r,
                                         const PatternPoints<typename Spu::rare_simd>& points) {
  Spu& spu = scene.spu();
  const V3<typename Spu::rare_simd>& p = points.at;
  spu.compute(scalar_work::kPattern);
  const bool is_gradient_noise = (r.kind_and_flags & pattern_flag::gradient_noise) != 0;
  switch (is_gradient_noise ? PatternCode::rare
                            : Patterns::kCode[r.kind_and_flags & pattern_flag::kind_mask]) {
  case PatternCode::resident:
    break;
  case PatternCode::plain: {
    const V3<typename Spu::rare_simd>* at = &p;
    V3<typename Spu::rare_simd> moved;
    if ((r.kind_and_flags & pattern_flag::shifted) != 0) {
      moved = p;
      at = &moved;
      spu.enter_module(modules::kNoise);
      module_noise::shift(spu, r, moved);
    }
    spu.enter_module(modules::kPatterns);
    return module_patterns::value(spu, r, *at);
  }
  case PatternCode::noise: {
    const V3<typename Spu::rare_simd>* at = &p;
    V3<typename Spu::rare_simd> nearest;
    if ((r.kind_and_flags & pattern_flag::at_features) != 0) {
      spu.enter_module(modules::kRarePatterns);
      nearest = module_rare::nearest_feature(scene, r, p);
      at = &nearest;
    }
    spu.enter_module(modules::kNoise);
    return module_noise::value(spu, r, *at);
  }
  case PatternCode::rare:
    spu.enter_module(modules::kRarePatterns);
    return module_rare::value(scene, r, points);
  case PatternCode::function:
    spu.enter_module(modules::kFunctions);
    return module_functions::value(scene, r, p);
  }
  return value_of<PatternCode::resident>(r, p);
}

} // namespace celltrace::kernel
