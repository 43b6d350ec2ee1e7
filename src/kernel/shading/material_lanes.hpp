// The materials of sixteen hits side by side. Kernel dialect.
#pragma once

#include "kernel/scalar_work.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/shading/surfaces.hpp"
#include "kernel/textures/normals.hpp"
#include "kernel/textures/pigments.hpp"

namespace celltrace::kernel {

/// MaterialRecord in structure-of-arrays form.
template <class S> struct MaterialLanes {
  using F = typename S::F;
  V3<S> pigment, ambient, reflection_min, reflection_max;
  F filter, transmit, opacity, diffuse, brilliance, phong, phong_size, specular, inverse_roughness, metallic;
  F reflection_falloff, reflection_metallic, inverse_reflection_exponent;
  uint32_t fresnel = 0, conserve_energy = 0;          ///< lanes
  uint32_t patterned = 0, disturbed = 0, layered = 0; ///< likewise, as MaterialRecord::flags
  bool bends_diffuse = false;                         ///< some brilliance is not 1
  bool has_phong = false, has_specular = false, has_metallic = false, has_reflection = false;
  bool has_falloff = false;
  bool bends_reflection = false; ///< some reflection exponent is not 1
  bool has_transmission = false;
};

/// The materials at `offsets` of the lanes in `lanes`; other lanes get that of one of them.
template <class Spu>
MaterialLanes<typename Spu::simd> gather_materials(SceneAccess<Spu>& scene, const WordLanes& offsets,
                                                   uint32_t lanes) {
  using S = typename Spu::simd;
  using F = typename S::F;
  MaterialLanes<S> m = {};
  bool first = true;
  for_each_value<S>(offsets, lanes, [&](uint32_t offset, uint32_t same) {
    scene.spu().compute(scalar_work::kMaterial);
    const MaterialRecord& r = *scene.material(offset);
    const auto take = S::M::from_bits(first ? 0xFFFF : same);
    first = false;
    const auto put = [&](F& field, float value) { field = S::select(take, F(value), field); };
    const auto put3 = [&](V3<S>& field, const float(&value)[3]) {
      put_in_lanes<Spu>(false, take, value, field);
    };
    put3(m.pigment, r.pigment);
    put3(m.ambient, r.ambient);
    put3(m.reflection_min, r.reflection_min);
    put3(m.reflection_max, r.reflection_max);
    put(m.filter, r.filter);
    put(m.transmit, r.transmit);
    put(m.opacity, r.opacity);
    put(m.diffuse, r.diffuse);
    put(m.brilliance, r.brilliance);
    put(m.phong, r.phong);
    put(m.phong_size, r.phong_size);
    put(m.specular, r.specular);
    put(m.inverse_roughness, r.inverse_roughness);
    put(m.metallic, r.metallic);
    put(m.reflection_falloff, r.reflection_falloff);
    put(m.reflection_metallic, r.reflection_metallic);
    put(m.inverse_reflection_exponent, r.inverse_reflection_exponent);
    if ((r.flags & material_flag::fresnel) != 0) m.fresnel |= same;
    if ((r.flags & material_flag::conserve_energy) != 0) m.conserve_energy |= same;
    if ((r.flags & material_flag::patterned) != 0) m.patterned |= same;
    if ((r.flags & material_flag::disturbed) != 0) m.disturbed |= same;
    if ((r.flags & material_flag::layered) != 0) m.layered |= same;
    const auto any = [](const float(&v)[3]) { return v[0] != 0.0f || v[1] != 0.0f || v[2] != 0.0f; };
    m.bends_diffuse |= r.brilliance != 1.0f;
    m.has_phong |= r.phong > 0.0f;
    m.has_specular |= r.specular > 0.0f;
    m.has_metallic |= r.metallic != 0.0f;
    m.has_reflection |= any(r.reflection_min) || any(r.reflection_max);
    m.has_falloff |= r.reflection_falloff != 1.0f;
    m.bends_reflection |= r.inverse_reflection_exponent != 1.0f;
    m.has_transmission |= r.filter != 0.0f || r.transmit != 0.0f;
  });
  return m;
}

/// The pigments of patterned materials at points, which gather_materials() leaves open.
template <class Spu>
[[gnu::noinline]] void add_pigments(SceneAccess<Spu>& scene, const WordLanes& offsets,
                                    const V3<typename Spu::simd>& point,
                                    MaterialLanes<typename Spu::simd>& m) {
  using S = typename Spu::simd;
  using F = typename S::F;
  scene.spu().enter_module(modules::kTextures);
  for_each_value<S>(offsets, m.patterned, [&](uint32_t offset, uint32_t same) {
    const MaterialRecord& r = *scene.material(offset);
    const bool old_opacity = (r.flags & material_flag::old_opacity) != 0;
    PigmentLanes<S> pigment;
    pigment_at(scene, r.pattern, point, same, pigment);
    const auto take = S::M::from_bits(same);
    const F filtered = old_opacity ? pigment.filter * max_component<S>(pigment.rgb) : pigment.filter;
    m.pigment = select<S>(take, pigment.rgb, m.pigment);
    m.filter = S::select(take, pigment.filter, m.filter);
    m.transmit = S::select(take, pigment.transmit, m.transmit);
    m.opacity = S::select(take, F(1.0f) - filtered - pigment.transmit, m.opacity);
    const auto clear = !((pigment.filter == F(0.0f)) & (pigment.transmit == F(0.0f)));
    m.has_transmission |= (clear.bits() & same) != 0;
  });
}

/// Disturbs the normals of surfaces in the lanes of `m.disturbed`.
template <class Spu>
[[gnu::noinline]] void disturb_normals(SceneAccess<Spu>& scene, const WordLanes& offsets,
                                       const MaterialLanes<typename Spu::simd>& m,
                                       Surfaces<typename Spu::simd>& surfaces) {
  scene.spu().enter_module(modules::kNormals);
  for_each_value<typename Spu::simd>(offsets, m.disturbed, [&](uint32_t offset, uint32_t same) {
    disturb_normal(scene, scene.material(offset)->normal, surfaces.point, same, surfaces.normal);
  });
}

/// POV-Ray's tint of metallic highlights and reflections: 1 + m (1 - F(x)) (pigment - 1), where x is the
/// angle over a right angle.
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
