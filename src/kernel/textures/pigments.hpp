// Pigments: the colours of surfaces, and what they let through. Kernel dialect.
#pragma once

#include "kernel/textures/map_walk.hpp"

namespace celltrace::kernel {

/// Colours with their transparency.
template <class S> struct PigmentLanes {
  V3<S> rgb;
  typename S::F filter, transmit;
};

/// The pigment of a pattern at the points of `lanes`.
template <class Spu>
[[gnu::noinline]] void pigment_at(SceneAccess<Spu>& scene, uint32_t pattern,
                                  const V3<typename Spu::simd>& point, uint32_t lanes,
                                  PigmentLanes<typename Spu::simd>& sum) {
  using S = typename Spu::simd;
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
