// The sky: layers of pigments over the background, farther away than anything else. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/textures/pigments.hpp"

namespace celltrace::kernel {

namespace detail {

/// Applies the sky to a part of a packet; see add_sky().
template <class Spu>
void add_sky_layers(SceneAccess<Spu>& scene, uint32_t sky, const V3<typename Spu::rare_simd>& direction,
                    uint32_t lanes, V3<typename Spu::rare_simd>& colour) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  const F zero(0.0f), one(1.0f);
  V3<S> sum = {zero, zero, zero}, through = {one, one, one}, tint = through;
  F filter = one, transmit = one;
  for (uint32_t material = sky; material != kNoOffset;) {
    const MaterialRecord& r = *scene.material(material);
    const uint32_t flags = r.flags, pattern = r.pattern;
    PigmentLanes<S> layer = {splat3<S>(r.pigment), F(r.filter), F(r.transmit)};
    material = r.below;
    if ((flags & material_flag::patterned) != 0) pigment_at<Spu>(scene, pattern, {direction}, lanes, layer);
    const F clear = layer.filter + layer.transmit;
    sum = sum + layer.rgb * through * (one - clear);
    if ((flags & material_flag::old_opacity) != 0) {
      through = through * clear;
      tint = tint * layer.rgb;
      filter = filter * layer.filter;
      transmit = transmit * layer.transmit;
    } else {
      through = through * layer.transmittance();
      tint = through;
      transmit = zero;
    }
  }
  colour = sum + colour * (tint * filter + V3<S>{transmit, transmit, transmit});
}

} // namespace detail

/// Replaces the background in `colour` by the sky that rays of `lanes`, with unit vectors `direction`, see if
/// they hit nothing. Layers before language version 3.7 dim the layers below by filter and transmit alone,
/// whatever their colours, but the background by the product of all colours.
template <class Spu>
CELLTRACE_ONE_COPY void add_sky(SceneAccess<Spu>& scene, uint32_t sky,
                                const V3<typename Spu::simd>& direction, uint32_t lanes,
                                V3<typename Spu::simd>& colour) {
  scene.spu().run_in_module(modules::kSky);
  scene.spu().enter_module(modules::kTextures);
  for_each_part<Spu>([&](uint32_t first) {
    const uint32_t some = part_of<Spu>(lanes, first);
    if (some == 0) return;
    V3<typename Spu::rare_simd> seen = part_of<Spu>(colour, first);
    detail::add_sky_layers(scene, sky, part_of<Spu>(direction, first), some, seen);
    set_part<Spu>(colour, first, seen);
  });
}

} // namespace celltrace::kernel
