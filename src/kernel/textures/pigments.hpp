// Pigments: the colours of surfaces, and what they let through. Kernel dialect.
#pragma once

#include "kernel/textures/map_walk.hpp"

namespace celltrace::kernel {

/// Colours with their transparency.
template <class S> struct PigmentLanes {
  V3<S> rgb;
  typename S::F filter, transmit;

  V3<S> transmittance() const { return rgb * filter + V3<S>{transmit, transmit, transmit}; }
};

/// The pigment of a pattern at the points of `lanes`, of a part of a packet.
template <class Spu>
[[gnu::noinline]] void pigment_at(SceneAccess<Spu>& scene, uint32_t pattern,
                                  const V3<typename Spu::rare_simd>& point, uint32_t lanes,
                                  PigmentLanes<typename Spu::rare_simd>& sum) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  const F zero(0.0f);
  sum = {{zero, zero, zero}, zero, zero};
  MapWalk<Spu, TextureStage::colours> walk(scene, point);
  walk.enter(pattern, F(1.0f), lanes);
  MapEntryRecord entry;
  F weight;
  uint32_t some;
  while (walk.next(entry, weight, some)) {
    sum.rgb = sum.rgb + splat3<S>(entry.rgb) * weight;
    sum.filter = sum.filter + weight * F(entry.filter);
    sum.transmit = sum.transmit + weight * F(entry.transmit);
  }
}

} // namespace celltrace::kernel
