// Find closest intersection, and what reaches a light: by the accelerator that the frame has. Kernel dialect.
#pragma once

#include "kernel/accel/grid_traversal.hpp"
#include "kernel/accel/bvh_traversal.hpp"

namespace celltrace::kernel {

template <class Spu> class Traversal {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  Traversal(SceneAccess<Spu>& scene, const FrameBlock& frame)
      : frame_(frame), objects_(scene), grid_(objects_, frame.grid), bvh_(objects_, frame) {}

  /// The closest hit of each ray in `lanes`. Other lanes' results are meaningless.
  void find_closest(const RayPacket& rays, uint32_t lanes, HitPacket& hits) {
    RayQuery query = {&rays, &hits, nullptr, nullptr, lanes};
    intersect(&query, 1);
  }

  /// Multiplies `light` of each ray in `lanes` by what lies between its origin and `distance` along it: 0
  /// behind an opaque object, the filtering of each surface crossed otherwise.
  void transmittance(const RayPacket& rays, uint32_t lanes, const FloatLanes& distance, VectorLanes& light) {
    RayQuery query = {&rays, nullptr, &distance, &light, lanes};
    intersect(&query, 1);
  }

  /// Answers all of these, at most a bundle's, all for hits or all for light: quicker than one by one if
  /// their rays have much in common.
  void intersect(RayQuery* queries, uint32_t count) {
    forget_hits(queries, count);
    if (uses_bvh()) {
      bvh_.intersect(queries, count);
    } else {
      for (uint32_t i = 0; i < count; ++i) {
        RayQuery& s = queries[i];
        if (s.hits != nullptr)
          grid_.find_closest(*s.rays, s.lanes, *s.hits);
        else
          s.lanes = grid_.transmittance(*s.rays, s.lanes, *s.distance, *s.light);
      }
    }
    clear_occluded(queries, count);
  }

  /// The same of light that comes from one place.
  void intersect(RayQuery* queries, uint32_t count, const float (&light)[3]) {
    if constexpr (Spu::direct_memory) {
      if (uses_bvh()) {
        bvh_.intersect(queries, count, light);
        return clear_occluded(queries, count);
      }
    }
    intersect(queries, count);
  }

  /// Begins with a bundle of primary rays. False: it is plain that none of them hits anything.
  bool enter(const PinholeBundle<S>& bundle) {
    return !uses_bvh() || bundle.packets == 0 || bvh_.enter(bundle);
  }
  /// Finds the hits of the bundle that was entered last; query i is of its packet i.
  void intersect(RayQuery* queries, const PinholeBundle<S>& bundle) {
    if (!uses_bvh() || bundle.packets == 0) return intersect(queries, kBundlePackets<Spu>);
    forget_hits(queries, kBundlePackets<Spu>);
    bvh_.intersect(queries, bundle);
  }

  const TraversalCounters& counters() const { return objects_.counters(); }
  void reset_counters() { objects_.reset_counters(); }

private:
  static void forget_hits(const RayQuery* queries, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      HitPacket* const hits = queries[i].hits;
      if (hits == nullptr) continue;
      F(kMaxHitDistance).store(hits->distance.lane);
      S::I::splat(-1).store(reinterpret_cast<int32_t*>(hits->object.lane));
    }
  }
  /// Of queries for light, those lanes to which none comes.
  static void clear_occluded(const RayQuery* queries, uint32_t count) {
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    for (uint32_t i = 0; i < count; ++i) {
      const RayQuery& s = queries[i];
      if (s.light == nullptr) continue;
      s.light->template store<S>(select<S>(S::M::from_bits(s.lanes), s.light->template load<S>(), dark));
    }
  }
  bool uses_bvh() const {
    return static_cast<AcceleratorKind>(frame_.accelerator) == AcceleratorKind::bvh;
  }

  const FrameBlock& frame_;
  ObjectTests<Spu> objects_;
  GridTraversal<Spu> grid_;
  BvhTraversal<Spu> bvh_;
};

} // namespace celltrace::kernel
