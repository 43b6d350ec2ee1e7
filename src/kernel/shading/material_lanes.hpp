// The materials of sixteen hits, one in each lane. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/lights/surfaces.hpp"
#include "kernel/scalar_work.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/normals.hpp"
#include "kernel/textures/pigments.hpp"

namespace celltrace::kernel {

/// MaterialRecord in structure-of-arrays form.
template <class S> struct MaterialLanes {
  using F = typename S::F;
  V3<S> pigment, ambient, reflection_min, reflection_max;
  F filter, transmit, opacity, diffuse, brilliance, phong, phong_size, specular, inverse_roughness, metallic;
  F reflection_falloff, reflection_metallic, inverse_reflection_exponent;
  uint32_t fresnel = 0, conserve_energy = 0;          ///< lanes with the material_flag of the same name
  uint32_t patterned = 0, disturbed = 0, layered = 0; ///< lanes with the material_flag of the same name
  uint32_t special = 0;                               ///< lanes with a FinishRecord
  const WordLanes* offsets;                           ///< offsets of the records, of the whole packet
  uint32_t flags = 0; ///< flags of all materials; members that no flag asks for are not set

  bool has(uint32_t some_flags) const { return (flags & some_flags) != 0; }
};

template <class Spu>
[[gnu::always_inline]] inline decltype(auto) part_of(const MaterialLanes<typename Spu::simd>& m,
                                                     uint32_t first) {
  return whole_or<Spu>(
      m, [&]() __attribute__((always_inline)) {
        const auto part = [first](const auto& field) { return part_of<Spu>(field, first); };
        MaterialLanes<typename Spu::rare_simd> o;
        o.offsets = m.offsets;
        o.pigment = part(m.pigment);
        o.ambient = part(m.ambient);
        o.reflection_min = part(m.reflection_min);
        o.reflection_max = part(m.reflection_max);
        o.filter = part(m.filter);
        o.transmit = part(m.transmit);
        o.opacity = part(m.opacity);
        o.diffuse = part(m.diffuse);
        o.brilliance = part(m.brilliance);
        o.phong = part(m.phong);
        o.phong_size = part(m.phong_size);
        o.specular = part(m.specular);
        o.inverse_roughness = part(m.inverse_roughness);
        o.metallic = part(m.metallic);
        o.reflection_falloff = part(m.reflection_falloff);
        o.reflection_metallic = part(m.reflection_metallic);
        o.inverse_reflection_exponent = part(m.inverse_reflection_exponent);
        o.fresnel = part(m.fresnel);
        o.conserve_energy = part(m.conserve_energy);
        o.patterned = part(m.patterned);
        o.disturbed = part(m.disturbed);
        o.layered = part(m.layered);
        o.flags = m.flags;
        return o;
      });
}

namespace detail {

/// Gives `taken` lanes a material; with `kAll` these are all lanes. `lanes` are the lanes that really have
/// the material. Sets the members that the flags `wanted` ask for.
template <class Spu, bool kAll = false>
CELLTRACE_ONE_COPY void gather_material(const MaterialRecord& r, uint32_t taken, uint32_t lanes,
                                        uint32_t wanted, MaterialLanes<typename Spu::simd>& m) {
  using S = typename Spu::simd;
  using F = typename S::F;
  const auto take = S::M::from_bits(taken);
  const auto put = [&](F& field, float value) {
    if constexpr (kAll)
      field = F(value);
    else
      field = S::select(take, F(value), field);
  };
  const auto put3 = [&](V3<S>& field, const float(&value)[3]) {
    if constexpr (kAll)
      field = splat3<S>(value);
    else
      put_in_lanes<Spu>(false, take, value, field);
  };
  put3(m.pigment, r.pigment);
  put3(m.ambient, r.ambient);
  put(m.filter, r.filter);
  put(m.transmit, r.transmit);
  put(m.opacity, r.opacity);
  put(m.diffuse, r.diffuse);
  if ((wanted & (material_flag::brilliance | material_flag::highlights)) != 0) {
    put(m.brilliance, r.brilliance);
    put(m.phong, r.phong);
    put(m.phong_size, r.phong_size);
    put(m.specular, r.specular);
    put(m.inverse_roughness, r.inverse_roughness);
    put(m.metallic, r.metallic);
  }
  if ((wanted & material_flag::reflects) != 0) {
    put3(m.reflection_min, r.reflection_min);
    put3(m.reflection_max, r.reflection_max);
    put(m.reflection_falloff, r.reflection_falloff);
    put(m.reflection_metallic, r.reflection_metallic);
    put(m.inverse_reflection_exponent, r.inverse_reflection_exponent);
  }
  const uint32_t flags = r.flags;
  m.flags |= flags;
  if ((flags & material_flag::fresnel) != 0) m.fresnel |= lanes;
  if ((flags & material_flag::conserve_energy) != 0) m.conserve_energy |= lanes;
  if ((flags & material_flag::patterned) != 0) m.patterned |= lanes;
  if ((flags & material_flag::disturbed) != 0) m.disturbed |= lanes;
  if ((flags & material_flag::layered) != 0) m.layered |= lanes;
  if (r.finish != kNoOffset) m.special |= lanes;
}

} // namespace detail

/// Returns the materials at `offsets` in `lanes`; other lanes get one of these materials.
template <class Spu>
MaterialLanes<typename Spu::simd> gather_materials(SceneAccess<Spu>& scene, const WordLanes& offsets,
                                                   uint32_t lanes) {
  MaterialLanes<typename Spu::simd> m; // the first material fills all lanes
  m.offsets = &offsets;
  bool first = true;
  for_each_value<typename Spu::simd>(offsets, lanes, [&](uint32_t offset, uint32_t same) {
    scene.spu().compute(scalar_work::kMaterial);
    const MaterialRecord& r = *scene.material(offset);
    // If all lanes have one material, members that it does not ask for need not be set.
    const uint32_t wanted = same == lanes ? r.flags : ~0u;
    Strategy<Spu>::template gather_material<Spu>(r, first, same, wanted, m);
    first = false;
  });
  return m;
}

/// Sets the pigments of patterned materials at points, which gather_materials() leaves out.
template <class Spu>
CELLTRACE_ONE_COPY void add_pigments(SceneAccess<Spu>& scene, const WordLanes& offsets,
                                     const PatternPoints<typename Spu::simd>& points,
                                     MaterialLanes<typename Spu::simd>& m) {
  using S = typename Spu::simd;
  scene.spu().enter_module(modules::kTextures);
  for_each_value<S>(offsets, m.patterned, [&](uint32_t offset, uint32_t same) {
    const MaterialRecord& r = *scene.material(offset);
    const uint32_t pattern = r.pattern;
    const bool old_opacity = (r.flags & material_flag::old_opacity) != 0;
    for_each_part<Spu>([&](uint32_t first) {
      using R = typename Spu::rare_simd;
      using F = typename R::F;
      const uint32_t some = part_of<Spu>(same, first);
      if (some == 0) return;
      PigmentLanes<R> pigment;
      pigment_at(scene, pattern, part_of<Spu>(points, first), some, pigment);
      const auto take = R::M::from_bits(some);
      const auto put = [&](typename S::F& field, const F& value) {
        set_part<Spu>(field, first, R::select(take, value, part_of<Spu>(field, first)));
      };
      const F filtered = old_opacity ? pigment.filter * max_component<R>(pigment.rgb) : pigment.filter;
      put(m.pigment.x, pigment.rgb.x);
      put(m.pigment.y, pigment.rgb.y);
      put(m.pigment.z, pigment.rgb.z);
      put(m.filter, pigment.filter);
      put(m.transmit, pigment.transmit);
      put(m.opacity, F(1.0f) - filtered - pigment.transmit);
      const auto clear = !((pigment.filter == F(0.0f)) & (pigment.transmit == F(0.0f)));
      if ((clear.bits() & some) != 0) m.flags |= material_flag::transmits;
    });
  });
}

/// Adds points of fractals that can be iterated together, for the materials of the packet with number
/// `packet`. add_pigments() will ask for their values.
template <class Spu, class Fractals>
void add_fractals(SceneAccess<Spu>& scene, uint32_t packet, const WordLanes& offsets,
                  const V3<typename Spu::simd>& points, uint32_t lanes, Fractals& fractals) {
  for_each_value<typename Spu::simd>(offsets, lanes, [&](uint32_t offset, uint32_t same) {
    const MaterialRecord& m = *scene.material(offset);
    if ((m.flags & material_flag::patterned) == 0) return;
    const PatternRecord& r = *scene.pattern(m.pattern);
    constexpr uint32_t kAsked = pattern_flag::kind_mask | pattern_flag::uv_mapping;
    if ((r.kind_and_flags & kAsked) != kPatternKind<FractalPattern> || !fractals.takes(r)) return;
    const auto at = to_pattern_space<TextureStage::colours>(scene, r, {points}, same).at;
    fractals.add(packet, r, same, {at.x, at.y});
  });
}

/// Disturbs the normals of surfaces in the lanes of `m.disturbed`. `lanes` is further input of patterns, or
/// null; it receives the disturbed normals, which also count for layers below that have no normals of their
/// own.
template <class Spu>
CELLTRACE_ONE_COPY void disturb_normals(SceneAccess<Spu>& scene, const WordLanes& offsets,
                                        const MaterialLanes<typename Spu::simd>& m, SurfaceLanes* lanes,
                                        Surfaces<typename Spu::simd>& surfaces) {
  using S = typename Spu::simd;
  scene.spu().enter_module(modules::kNormals);
  for_each_value<S>(offsets, m.disturbed, [&](uint32_t offset, uint32_t same) {
    disturb_normal<Spu>(scene, scene.material(offset)->normal, {surfaces.point, lanes}, same,
                        surfaces.normal);
  });
  if (lanes == nullptr) return;
  lanes->normal.template store<S>(
      select<S>(S::M::from_bits(m.disturbed), surfaces.normal, lanes->normal.template load<S>()));
}

/// Returns POV-Ray's tint of metallic highlights and reflections: 1 + m (1 - F(x)) (pigment - 1), where x is
/// the angle over a right angle.
template <class S>
V3<S> metallic_tint(const typename S::F& metallic, const typename S::F& cosine, const V3<S>& pigment) {
  using F = typename S::F;
  const F x = acos_unit<S>(S::min(S::max(cosine, F(0.0f)), F(1.0f))) * F(0.63661977f);
  const F away = x - F(1.12f);
  const F fresnel = S::min(S::max(F(0.014567225f) / (away * away) - F(0.011612903f), F(0.0f)), F(1.0f));
  const F tint = metallic * (F(1.0f) - fresnel);
  const V3<S> one = {F(1.0f), F(1.0f), F(1.0f)};
  return one + (pigment - one) * tint;
}

} // namespace celltrace::kernel
