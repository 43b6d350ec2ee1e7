// Find closest intersection, and what reaches a light: by the accelerator that the frame has. Kernel dialect.
#pragma once

#include "kernel/grid_traversal.hpp"
#include "kernel/hierarchy_traversal.hpp"

namespace celltrace::kernel {

template <class Spu> class Traversal {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  Traversal(SceneAccess<Spu>& scene, const FrameBlock& frame)
      : frame_(frame), objects_(scene), grid_(objects_, frame.grid), hierarchy_(objects_, frame) {}

  /// The closest hit of each ray in `lanes`. Other lanes' results are meaningless.
  void find_closest(const RayPacket& rays, uint32_t lanes, HitPacket& hits) {
    Search search = {&rays, &hits, nullptr, nullptr, lanes};
    run(&search, 1);
  }

  /// Multiplies `light` of each ray in `lanes` by what lies between its origin and `distance` along it: 0
  /// behind an opaque object, the filtering of each surface crossed otherwise.
  void attenuate(const RayPacket& rays, uint32_t lanes, const FloatLanes& distance, VectorLanes& light) {
    Search search = {&rays, nullptr, &distance, &light, lanes};
    run(&search, 1);
  }

  /// Answers all of these, at most a bundle's, all for hits or all for light: quicker than one by one if
  /// their rays have much in common.
  void run(Search* searches, uint32_t count) {
    forget_hits(searches, count);
    if (by_hierarchy()) {
      hierarchy_.run(searches, count);
    } else {
      for (uint32_t i = 0; i < count; ++i) {
        Search& s = searches[i];
        if (s.hits != nullptr)
          grid_.find_closest(*s.rays, s.lanes, *s.hits);
        else
          s.lanes = grid_.attenuate(*s.rays, s.lanes, *s.distance, *s.light);
      }
    }
    darken(searches, count);
  }

  /// The same of light that comes from one place.
  void run(Search* searches, uint32_t count, const float (&light)[3]) {
    if constexpr (Spu::direct_memory) {
      if (by_hierarchy()) {
        hierarchy_.run(searches, count, light);
        return darken(searches, count);
      }
    }
    run(searches, count);
  }

  /// Begins with a bundle of primary rays. False: it is plain that none of them hits anything.
  bool enter(const PinholeBundle<S>& bundle) {
    return !by_hierarchy() || bundle.packets == 0 || hierarchy_.enter(bundle);
  }
  /// Finds the hits of the bundle that was entered last; search i is of its packet i.
  void run(Search* searches, const PinholeBundle<S>& bundle) {
    if (!by_hierarchy() || bundle.packets == 0) return run(searches, kBundlePackets<Spu>);
    forget_hits(searches, kBundlePackets<Spu>);
    hierarchy_.run(searches, bundle);
  }

  const TraversalCounters& counters() const { return objects_.counters(); }
  void reset_counters() { objects_.reset_counters(); }

private:
  static void forget_hits(const Search* searches, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      HitPacket* const hits = searches[i].hits;
      if (hits == nullptr) continue;
      F(kMaxHitDistance).store(hits->distance.lane);
      S::I::splat(-1).store(reinterpret_cast<int32_t*>(hits->object.lane));
    }
  }
  /// Of searches for light, those lanes to which none comes.
  static void darken(const Search* searches, uint32_t count) {
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    for (uint32_t i = 0; i < count; ++i) {
      const Search& s = searches[i];
      if (s.light == nullptr) continue;
      s.light->template store<S>(select<S>(S::M::from_bits(s.lanes), s.light->template load<S>(), dark));
    }
  }
  bool by_hierarchy() const {
    return static_cast<AcceleratorKind>(frame_.accelerator) == AcceleratorKind::hierarchy;
  }

  const FrameBlock& frame_;
  ObjectTests<Spu> objects_;
  GridTraversal<Spu> grid_;
  HierarchyTraversal<Spu> hierarchy_;
};

} // namespace celltrace::kernel
