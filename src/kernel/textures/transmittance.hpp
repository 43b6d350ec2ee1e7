// What surfaces let through of the light that shadow rays ask for. Kernel dialect.
#pragma once

#include "kernel/textures/pigments.hpp"

namespace celltrace::kernel {

namespace detail {

/// Of a texture that is no map: the product of its layers.
template <class Spu>
[[gnu::noinline]] void filter_of_layers(SceneAccess<Spu>& scene, uint32_t material,
                                        const V3<typename Spu::simd>& point, uint32_t lanes,
                                        V3<typename Spu::simd>& product) {
  using S = typename Spu::simd;
  using F = typename S::F;
  product = {F(1.0f), F(1.0f), F(1.0f)};
  for (;;) {
    const MaterialRecord& r = *scene.material(material);
    const uint32_t flags = r.flags, pattern = r.pattern, below = r.below;
    PigmentLanes<S> pigment = {splat3<S>(r.pigment), F(r.filter), F(r.transmit)};
    if ((flags & material_flag::patterned) != 0) pigment_at(scene, pattern, point, lanes, pigment);
    product = product *
              (pigment.rgb * pigment.filter + V3<S>{pigment.transmit, pigment.transmit, pigment.transmit});
    if ((flags & material_flag::layered) == 0) return;
    material = below;
  }
}

} // namespace detail

/// The transmittance of the texture at `material` at the points of `lanes`.
template <class Spu>
[[gnu::noinline]] void transmittance_at(SceneAccess<Spu>& scene, uint32_t material,
                                        const V3<typename Spu::simd>& point, uint32_t lanes,
                                        V3<typename Spu::simd>& transmittance) {
  using S = typename Spu::simd;
  using F = typename S::F;
  scene.spu().enter_module(modules::kTextures);
  const uint32_t map = map_of(*scene.material(material));
  if (map == kNoOffset) return detail::filter_of_layers(scene, material, point, lanes, transmittance);
  transmittance = {F(0.0f), F(0.0f), F(0.0f)};
  MapWalk<Spu, TextureStage::colours> walk(scene, point, MapOf::textures);
  walk.enter(map, F(1.0f), lanes);
  MapEntryRecord entry;
  F weight;
  uint32_t some;
  V3<S> one;
  while (walk.next(entry, weight, some)) {
    detail::filter_of_layers(scene, entry.child, point, some, one);
    transmittance = transmittance + one * weight;
  }
}

} // namespace celltrace::kernel
