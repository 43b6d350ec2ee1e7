// Transmittance of surfaces for shadow rays. Kernel dialect.
#pragma once

#include "kernel/textures/pigments.hpp"

namespace celltrace::kernel {

namespace detail {

/// Finds the transmittance of a texture that is no map: the product over its layers.
template <class Spu>
[[gnu::noinline]] void filter_of_layers(SceneAccess<Spu>& scene, uint32_t material,
                                        const PatternPoints<typename Spu::rare_simd>& points, uint32_t lanes,
                                        V3<typename Spu::rare_simd>& product) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  product = {F(1.0f), F(1.0f), F(1.0f)};
  for (;;) {
    const MaterialRecord& r = *scene.material(material);
    const uint32_t flags = r.flags, pattern = r.pattern, below = r.below;
    PigmentLanes<S> pigment = {splat3<S>(r.pigment), F(r.filter), F(r.transmit)};
    if ((flags & material_flag::patterned) != 0) pigment_at(scene, pattern, points, lanes, pigment);
    product = product * pigment.transmittance();
    if ((flags & material_flag::layered) == 0) return;
    material = below;
  }
}

/// Finds the transmittance of any texture.
template <class Spu>
[[gnu::noinline]] void filter_of_texture(SceneAccess<Spu>& scene, uint32_t material,
                                         const PatternPoints<typename Spu::rare_simd>& points, uint32_t lanes,
                                         V3<typename Spu::rare_simd>& filter) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  scene.spu().run_in_module(modules::kTextures);
  const uint32_t map = map_of(*scene.material(material));
  if (map == kNoOffset) return filter_of_layers(scene, material, points, lanes, filter);
  filter = {F(0.0f), F(0.0f), F(0.0f)};
  MapWalk<Spu, TextureStage::colours> walk(scene, points, MapOf::textures);
  walk.enter(map, F(1.0f), lanes);
  MapEntryRecord entry;
  F weight;
  uint32_t some;
  V3<S> one;
  while (walk.next(entry, weight, some)) {
    filter_of_layers(scene, entry.child, points, some, one);
    filter = filter + one * weight;
  }
}

} // namespace detail

/// Finds the transmittance of the texture at `material` at the points of `lanes` in a part of a packet. A
/// single colour needs no code module: shadow rays through plain glass are frequent.
template <class Spu>
void transmittance_at(SceneAccess<Spu>& scene, uint32_t material,
                      const PatternPoints<typename Spu::rare_simd>& points, uint32_t lanes,
                      V3<typename Spu::rare_simd>& transmittance) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  const MaterialRecord& r = *scene.material(material);
  if ((r.flags & (material_flag::mapped | material_flag::patterned | material_flag::layered)) == 0) {
    transmittance = PigmentLanes<S>{splat3<S>(r.pigment), F(r.filter), F(r.transmit)}.transmittance();
    return;
  }
  scene.spu().enter_module(modules::kTextures);
  detail::filter_of_texture(scene, material, points, lanes, transmittance);
}

/// Finds the transmittance of a surface. Its material is at `material`; if it is `blended`, a BlendRecord
/// with three materials is there, which are weighted by the barycentric coordinates u and v.
template <class Spu>
[[gnu::always_inline]] inline void
surface_transmittance(SceneAccess<Spu>& scene, uint32_t material, bool blended,
                      const PatternPoints<typename Spu::rare_simd>& points,
                      const typename Spu::rare_simd::F& u, const typename Spu::rare_simd::F& v,
                      uint32_t lanes, V3<typename Spu::rare_simd>& transmittance) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  if (!blended) return transmittance_at(scene, material, points, lanes, transmittance);
  Kept<Spu, BlendRecord> blend = *scene.blend(material);
  const F weights[3] = {F(1.0f) - u - v, u, v};
  transmittance = {F(0.0f), F(0.0f), F(0.0f)};
  V3<S> of_corner;
  for (uint32_t corner = 0; corner < 3; ++corner) {
    transmittance_at(scene, blend.material[corner], points, lanes, of_corner);
    transmittance = transmittance + of_corner * weights[corner];
  }
}

} // namespace celltrace::kernel
