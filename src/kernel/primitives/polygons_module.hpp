// The code module of polygons. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/primitives/polygon.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

namespace module_polygons {

/// Removes the crossings outside a polygon: a crossing is inside if an odd number of edges is to one side of
/// it. An end that two edges share counts for one of them, as rows are half-open intervals.
template <class Spu>
CELLTRACE_ONE_COPY void cut_out(SceneAccess<Spu>& scene, const ExtraRecord& extra,
                                Crossings<typename Spu::simd>& c) {
  using S = typename Spu::simd;
  using F = typename S::F;
  scene.spu().run_in_module(modules::kPolygons);
  const uint32_t lanes = c.near_hit.bits();
  if (lanes == 0) return;
  const ShapeData edges = ShapeData::of(extra);
  uint32_t odd = 0;
  for (uint32_t i = 0; i < edges.count; ++i) {
    const PolygonEdge edge(
        *scene.shape_data(edges.first + i * static_cast<uint32_t>(sizeof(ShapeDataRecord))));
    const F low(edge.low);
    const auto beside =
        (c.v >= low) & (c.v < F(edge.high)) & (c.u < F(edge.column) + (c.v - low) * F(edge.slope));
    odd ^= beside.bits();
  }
  c.near_hit = S::M::from_bits(lanes & odd);
}

} // namespace module_polygons

} // namespace celltrace::kernel
