// The cells pattern: unit cubes with a random number each. Kernel dialect.
#pragma once

#include "kernel/textures/features.hpp"
#include "kernel/textures/lattice.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

struct CellsPattern : RarePattern {
  static constexpr const char* kName = "cells";

  template <class Spu>
  [[gnu::always_inline]] static typename Spu::rare_simd::F
  value(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    Features<Spu> features(scene, r.table);
    F value(0.0f);
    for_each_cell_of<S>({snap<S>(p.x), snap<S>(p.y), snap<S>(p.z)},
                        [&](uint32_t lanes, const uint32_t(&cell)[3], const V3<S>&) {
                          const float number = features.at(features.number_of(cell)).place[0];
                          value = S::select(S::M::from_bits(lanes), F(number), value);
                        });
    return value;
  }
};

} // namespace celltrace::kernel
