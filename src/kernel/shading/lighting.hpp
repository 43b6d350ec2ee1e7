// Light that a surface sends toward the viewer, without secondary rays. The terms are those of Hall's model
// that POV-Ray uses: ambient, diffuse with brilliance, Phong and Blinn highlights. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/lights/illumination.hpp"
#include "kernel/shading/finishes.hpp"
#include "kernel/shading/hit_points.hpp"
#include "kernel/shading/material_lanes.hpp"

namespace celltrace::kernel {

namespace detail {

/// Bound beyond which there is no highlight: a cosine to the power n is at most exp(-n (1 - cosine)), which
/// is less than 1e-9 if n (1 - cosine) is more than this.
constexpr float kLeastHighlight = 20.7f;

template <class S>
typename S::F phong_term(const Surfaces<S>& s, const MaterialLanes<S>& m, const IncidentLight<S>& light) {
  using F = typename S::F;
  const V3<S> mirrored = s.direction - s.normal * (F(2.0f) * dot<S>(s.direction, s.normal));
  const F cosine = dot<S>(mirrored, light.direction);
  // POV-Ray drops wide angles if the exponent makes their highlights invisible.
  const auto seen = (cosine > F(0.0f)) & ((m.phong_size < F(60.0f)) | (cosine > F(0.0008f)));
  if constexpr (S::kLanes == kSimdLanes) { // only where there is room for code
    const auto shines =
        seen & !(m.phong == F(0.0f)) & (m.phong_size * (F(1.0f) - cosine) < F(kLeastHighlight));
    if ((shines.bits() & light.facing) == 0) return F(0.0f);
  }
  return S::select(seen, m.phong * pow<S>(S::max(cosine, F(0.0f)), m.phong_size), F(0.0f));
}

template <class S>
typename S::F specular_term(const Surfaces<S>& s, const MaterialLanes<S>& m, const IncidentLight<S>& light) {
  using F = typename S::F;
  const V3<S> between = light.direction - s.direction;
  if constexpr (S::kLanes == kSimdLanes) {
    // The test is on the cosine's square, without a root or a division.
    const F along = dot<S>(between, s.normal), square = dot<S>(between, between);
    const F least = m.inverse_roughness - F(kLeastHighlight), scaled = along * m.inverse_roughness;
    const auto shines = (along > F(0.0f)) & !(m.specular == F(0.0f)) &
                        ((least < F(0.0f)) | (scaled * scaled > least * least * square));
    if ((shines.bits() & light.facing) == 0) return F(0.0f);
  }
  const V3<S> half = normalise<S>(between);
  const F cosine = dot<S>(half, s.normal);
  return S::select(cosine > F(0.0f), m.specular * pow<S>(S::max(cosine, F(0.0f)), m.inverse_roughness),
                   F(0.0f));
}

template <class S>
V3<S> highlight(const Surfaces<S>& s, const MaterialLanes<S>& m, const IncidentLight<S>& light) {
  using F = typename S::F;
  F strength(0.0f);
  if (m.has(material_flag::phong)) strength = strength + phong_term<S>(s, m, light);
  if (m.has(material_flag::specular)) strength = strength + specular_term<S>(s, m, light);
  if constexpr (S::kLanes == kSimdLanes) // most surfaces are beside their highlights and need no tint
    if ((strength > F(0.0f)).bits() == 0) return {F(0.0f), F(0.0f), F(0.0f)};
  const V3<S> white = light.colour * strength;
  return m.has(material_flag::metallic) ? white * metallic_tint<S>(m.metallic, light.cosine, m.pigment)
                                        : white;
}

/// Returns the cosine of light to the power of the materials' brilliance.
template <class Spu>
[[gnu::always_inline]] inline typename Spu::simd::F
diffuse_lobe(const MaterialLanes<typename Spu::simd>& m, const IncidentLight<typename Spu::simd>& light) {
  using S = typename Spu::simd;
  using R = typename Spu::rare_simd;
  using RF = typename R::F;
  typename S::F lobe = light.cosine;
  if (m.has(material_flag::brilliance)) {
    if (Strategy<Spu>::template raise_to_whole_power<S>(m.brilliance, light.facing, lobe)) return lobe;
    by_parts<Spu>(
        lobe, [](const RF& cosine, const RF& brilliance) { return pow<R>(cosine, brilliance); }, light.cosine,
        m.brilliance);
  }
  return lobe;
}

/// Returns the light that surfaces reflect. Rare features of materials are computed by parts, as their code
/// takes much local store.
template <class Spu>
V3<typename Spu::simd> reflected_light(const Surfaces<typename Spu::simd>& s,
                                       const MaterialLanes<typename Spu::simd>& m,
                                       const IncidentLight<typename Spu::simd>& light, bool highlights) {
  using R = typename Spu::rare_simd;
  const typename Spu::simd::F lobe = diffuse_lobe<Spu>(m, light);
  V3<typename Spu::simd> sum = m.pigment * light.colour * (m.diffuse * m.opacity * lobe);
  if (highlights && m.has(material_flag::highlights))
    for_each_part<Spu>([&](uint32_t first) {
      set_part<Spu>(sum, first,
                    part_of<Spu>(sum, first) + highlight<R>(part_of<Spu>(s, first), part_of<Spu>(m, first),
                                                            part_of<Spu>(light, first)));
    });
  return sum;
}

/// Finds the light that surfaces reflect if light reaches some of them from behind, too: light from behind
/// has a share of its own and no highlights, or counts as if it came from the front. Sets light that does not
/// count to 0.
template <class Spu>
CELLTRACE_ONE_COPY void light_of_both_sides(SceneAccess<Spu>& scene, const Surfaces<typename Spu::simd>& s,
                                            const MaterialLanes<typename Spu::simd>& m, bool highlights,
                                            IncidentLight<typename Spu::simd>& light,
                                            V3<typename Spu::simd>& sent) {
  using S = typename Spu::simd;
  using F = typename S::F;
  scene.spu().run_in_module(modules::kFinishes);
  const uint32_t behind = (light.cosine < F(0.0f)).bits() & light.facing & ~s.lit_through;
  light.cosine = S::abs(light.cosine);
  sent = reflected_light<Spu>(s, m, light, highlights);
  if (behind == 0) return;
  F share(0.0f);
  for_each_value<S>(*m.offsets, behind, [&](uint32_t offset, uint32_t same) {
    share = S::select(S::M::from_bits(same), F(scene.material(offset)->diffuse_behind), share);
  });
  const F lobe = diffuse_lobe<Spu>(m, light);
  const auto is_behind = S::M::from_bits(behind);
  const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
  light.colour = select<S>(is_behind & (share == F(0.0f)), dark, light.colour);
  sent = select<S>(is_behind, m.pigment * light.colour * (share * m.opacity * lobe), sent);
}

} // namespace detail

/// Number of lights that are processed at a time: the light that surfaces send on is kept for each of them.
constexpr uint32_t kLightsARound = 4;

/// Lights [first, first + count) of a frame, and the light of each that surfaces send on if nothing occludes
/// it. Shadow rays are traced only where that light counts. The first round also adds the light that surfaces
/// send without lights.
struct LightRound {
  uint32_t first, count;
  VectorLanes* gathered;          ///< index: light in the round; 0 for lights without shadow rays
  bool only_gathers = false;      ///< nothing is added besides: surfaces are shaded again
  bool is_fresh = false;          ///< nothing has been gathered yet, and `gathered` is undefined
  ShadowRays* to_first = nullptr; ///< if not null: receives the rays toward the first light

  /// Returns the round of a frame that begins with light `first`.
  static LightRound from(const FrameBlock& frame, uint32_t first, VectorLanes* gathered) {
    const uint32_t left = frame.light_count - first;
    return {first, left < kLightsARound ? left : kLightsARound, gathered};
  }
  bool is_first() const { return first == 0 && !only_gathers; }
  /// Returns the first light of the next round, which is the number of lights if there is no further round.
  uint32_t next() const { return first + count; }

  template <class S> void clear() const {
    const typename S::F zero(0.0f);
    for (uint32_t i = 0; i < count; ++i)
      gathered[i].template store<S>({zero, zero, zero});
  }
  template <class S> V3<S> sum() const {
    const typename S::F zero(0.0f);
    V3<S> sum = {zero, zero, zero};
    for (uint32_t i = 0; i < count; ++i)
      sum = sum + gathered[i].template load<S>();
    return sum;
  }
  /// Adds the sum of the gathered light. Not inlined, as one copy saves local store.
  template <class S> CELLTRACE_ONE_COPY void add_to(VectorLanes& light, uint32_t lanes) const {
    const V3<S> sum = this->sum<S>();
    const V3<S> before = light.template load<S>();
    light.template store<S>(select<S>(S::M::from_bits(lanes), before + sum, before));
  }
};

/// Light counts if one of its channels is above this value: less light does not change a pixel.
constexpr float kLeastLight = 1e-6f;

/// Returns the lanes of `lanes` with light above `least`.
template <class S>
CELLTRACE_ONE_COPY uint32_t lanes_above(const VectorLanes& light, uint32_t lanes, float least) {
  const V3<S> l = light.template load<S>();
  const typename S::F most = S::max(S::abs(l.x), S::max(S::abs(l.y), S::abs(l.z)));
  return (most > typename S::F(least)).bits() & lanes;
}

/// Gathers the light that the surfaces of `lanes` send on of the round's lights with shadow rays, times
/// `weight`. Returns the other light without the weight: ambient light, and that of lights without shadow
/// rays. Afterwards the round is fresh only if no surface sends on any light.
template <class Spu>
V3<typename Spu::simd> local_light(SceneAccess<Spu>& scene, const FrameBlock& frame, LightRound& round,
                                   const Surfaces<typename Spu::simd>& s,
                                   const MaterialLanes<typename Spu::simd>& m, uint32_t lanes,
                                   const V3<typename Spu::simd>& weight) {
  using S = typename Spu::simd;
  using F = typename S::F;
  const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
  V3<S> sum = round.is_first() ? m.pigment * m.ambient * m.opacity : dark;
  if (Strategy<Spu>::template are_dark<Spu>(s, m, lanes)) return sum;
  for_each_light(scene, frame, round.first, round.count, [&](uint32_t number, const LightRecord& light) {
    IncidentLight<S> incident(light.colour);
    illuminate(scene, light, s, lanes, incident);
    const uint32_t facing = incident.facing;
    VectorLanes& gathered = round.gathered[number - round.first];
    const bool is_fresh = Strategy<Spu>::is_fresh(round);
    if (facing == 0) {
      if (is_fresh) gathered.template store<S>(dark);
      return;
    }
    const bool needs_rays = needs_shadow_rays(light);
    if (needs_rays && Strategy<Spu>::wants_rays(round, number))
      make_shadow_rays(s.point, *s.objects, incident, round.to_first->rays, round.to_first->distance);
    scene.spu().compute(scalar_work::kLight);
    V3<S> sent;
    if (s.any_side != 0) {
      scene.spu().enter_module(modules::kFinishes);
      detail::light_of_both_sides(scene, s, m, !is_shadowless(light), incident, sent);
    } else {
      incident.cosine = S::max(incident.cosine, F(0.0f));
      sent = detail::reflected_light<Spu>(s, m, incident, !is_shadowless(light));
    }
    if (m.special != 0) {
      scene.spu().enter_module(modules::kFinishes);
      change_special_light(scene, s, m, incident, number, sent);
    }
    sent = select<S>(S::M::from_bits(facing), sent, dark);
    if (!needs_rays) {
      sum = sum + sent;
      if (is_fresh) gathered.template store<S>(dark);
      return;
    }
    const V3<S> more = sent * weight;
    gathered.template store<S>(is_fresh ? more : gathered.template load<S>() + more);
  });
  Strategy<Spu>::end_fresh(round);
  return sum;
}

} // namespace celltrace::kernel
