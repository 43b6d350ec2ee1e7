// The sky: layers of pigments over the background, as far away as nothing else. Kernel dialect.
#pragma once

#include "kernel/textures/pigments.hpp"

namespace celltrace::kernel {

/// What rays of `lanes` see that hit nothing, of unit `direction`. The background comes in `colour`. Layers
/// before language version 3.7 dim those below them by filter and transmit alone, whatever their colours, but
/// the background by the product of all colours.
template <class Spu>
[[gnu::noinline]] void add_sky(SceneAccess<Spu>& scene, uint32_t sky, const V3<typename Spu::simd>& direction,
                               uint32_t lanes, V3<typename Spu::simd>& colour) {
  using S = typename Spu::simd;
  using F = typename S::F;
  scene.spu().enter_module(modules::kTextures);
  const F zero(0.0f), one(1.0f);
  V3<S> sum = {zero, zero, zero}, through = {one, one, one}, tint = through;
  F filter = one, transmit = one;
  for (uint32_t material = sky; material != kNoOffset;) {
    const MaterialRecord& r = *scene.material(material);
    const uint32_t flags = r.flags, pattern = r.pattern;
    PigmentLanes<S> layer = {splat3<S>(r.pigment), F(r.filter), F(r.transmit)};
    material = r.below;
    if ((flags & material_flag::patterned) != 0) pigment_at(scene, pattern, direction, lanes, layer);
    const F clear = layer.filter + layer.transmit;
    sum = sum + layer.rgb * through * (one - clear);
    if ((flags & material_flag::old_opacity) != 0) {
      through = through * clear;
      tint = tint * layer.rgb;
      filter = filter * layer.filter;
      transmit = transmit * layer.transmit;
    } else {
      through = through * (layer.rgb * layer.filter + V3<S>{layer.transmit, layer.transmit, layer.transmit});
      tint = through;
      transmit = zero;
    }
  }
  colour = sum + colour * (tint * filter + V3<S>{transmit, transmit, transmit});
}

} // namespace celltrace::kernel
