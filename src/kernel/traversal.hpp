// Find closest intersection, and what reaches a light: by the accelerator that the frame has. Kernel dialect.
#pragma once

#include "kernel/grid_traversal.hpp"
#include "kernel/hierarchy_traversal.hpp"

namespace celltrace::kernel {

template <class Spu> class Traversal {
public:
  Traversal(SceneAccess<Spu>& scene, const FrameBlock& frame)
      : frame_(frame), objects_(scene), grid_(objects_, frame.grid), hierarchy_(objects_, frame.hierarchy) {}

  /// The closest hit of each ray in `lanes`. Other lanes' results are meaningless.
  void find_closest(const RayPacket& rays, uint32_t lanes, HitPacket& hits) {
    using S = typename Spu::simd;
    typename S::F(kMaxHitDistance).store(hits.distance.lane);
    S::I::splat(-1).store(reinterpret_cast<int32_t*>(hits.object.lane));
    if (by_hierarchy())
      hierarchy_.find_closest(rays, lanes, hits);
    else
      grid_.find_closest(rays, lanes, hits);
  }

  /// Multiplies `light` of each ray in `lanes` by what lies between its origin and `distance` along it: 0
  /// behind an opaque object, the filtering of each surface crossed otherwise. The number of the light does
  /// not matter here.
  void attenuate(const RayPacket& rays, uint32_t lanes, const FloatLanes& distance, VectorLanes& light,
                 uint32_t = 0) {
    using S = typename Spu::simd;
    using F = typename S::F;
    const uint32_t lit = by_hierarchy() ? hierarchy_.attenuate(rays, lanes, distance, light)
                                        : grid_.attenuate(rays, lanes, distance, light);
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    light.template store<S>(select<S>(S::M::from_bits(lit), light.template load<S>(), dark));
  }

  const TraversalCounters& counters() const { return objects_.counters(); }
  void reset_counters() { objects_.reset_counters(); }

private:
  bool by_hierarchy() const {
    return static_cast<AcceleratorKind>(frame_.accelerator) == AcceleratorKind::hierarchy;
  }

  const FrameBlock& frame_;
  ObjectTests<Spu> objects_;
  GridTraversal<Spu> grid_;
  HierarchyTraversal<Spu> hierarchy_;
};

} // namespace celltrace::kernel
