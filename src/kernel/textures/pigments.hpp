// Pigments: the colours of surfaces and their transparency. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/textures/map_walk.hpp"

namespace celltrace::kernel {

namespace detail {

/// Finds the pigment of a pattern whose map has colours only: blends the entries on both sides of its values.
template <class Spu>
CELLTRACE_ONE_COPY void blend_colours(SceneAccess<Spu>& scene, uint32_t pattern,
                                      const PatternPoints<typename Spu::rare_simd>& points, uint32_t lanes,
                                      PigmentLanes<typename Spu::rare_simd>& pigment) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  using M = typename S::M;
  Kept<Spu, PatternRecord> r = *scene.pattern(pattern);
  const F value = pattern_value(scene, r, to_pattern_space<TextureStage::colours>(scene, r, points, lanes));
  const F zero(0.0f);
  pigment = {{zero, zero, zero}, zero, zero};
  find_interval<S>(
      scene, r, value,
      [&](const M& some, uint32_t, const MapEntryRecord& entry) {
        pigment = select<S>(some, pigment_of<S>(entry), pigment);
      },
      [&](const M& some, uint32_t, const MapEntryRecord& below, const MapEntryRecord& above, const F& share) {
        const PigmentLanes<S> blend = pigment_of<S>(below) * (F(1.0f) - share) + pigment_of<S>(above) * share;
        pigment = select<S>(some, blend, pigment);
      });
}

/// Finds the pigment of any pattern: adds up the leaves of its tree of maps by their weights.
template <class Spu>
CELLTRACE_ONE_COPY void add_up_leaves(SceneAccess<Spu>& scene, uint32_t pattern,
                                      const PatternPoints<typename Spu::rare_simd>& points, uint32_t lanes,
                                      PigmentLanes<typename Spu::rare_simd>& pigment) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  const F zero(0.0f);
  pigment = {{zero, zero, zero}, zero, zero};
  MapWalk<Spu, TextureStage::colours> walk(scene, points);
  walk.enter(pattern, F(1.0f), lanes);
  MapEntryRecord entry;
  F weight;
  uint32_t some;
  while (walk.next(entry, weight, some))
    pigment = pigment + walk.pigment(entry) * weight;
}

} // namespace detail

/// Finds the pigment of a pattern at the points of `lanes` in a part of a packet.
template <class Spu>
void pigment_at(SceneAccess<Spu>& scene, uint32_t pattern,
                const PatternPoints<typename Spu::rare_simd>& points, uint32_t lanes,
                PigmentLanes<typename Spu::rare_simd>& pigment) {
  const uint32_t flags = scene.pattern(pattern)->kind_and_flags;
  const uint32_t kind = flags & pattern_flag::kind_mask;
  if ((flags & (pattern_flag::nested | pattern_flag::average)) == 0 && !Patterns::kAreLists[kind] &&
      !is_colour(kind))
    detail::blend_colours(scene, pattern, points, lanes, pigment);
  else
    detail::add_up_leaves(scene, pattern, points, lanes, pigment);
}

} // namespace celltrace::kernel
