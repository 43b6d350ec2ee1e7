// Ray queries with the frame's accelerator: closest hits, and the transmittance toward a light. Kernel
// dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/accel/bvh_traversal.hpp"
#include "kernel/accel/grid_traversal.hpp"

namespace celltrace::kernel {

/// Sets of accelerators that a program can use, as bits; code of accelerators that it never uses takes no
/// local store.
constexpr uint32_t kGridOnly = 1u << static_cast<uint32_t>(AcceleratorKind::grid);
constexpr uint32_t kBvhOnly = 1u << static_cast<uint32_t>(AcceleratorKind::bvh);
constexpr uint32_t kAnyAccelerator = kGridOnly | kBvhOnly;

/// Answers ray queries with the uniform grid or the BVH. A strategy's BundleQueries have:
///
///   intersect_toward(queries, count, light)   answers the queries toward a light together; false: not done
///   lists_all()                         true if all objects are tested, without an accelerator
template <class Spu, uint32_t kAccelerators = kAnyAccelerator>
class Traversal : public Strategy<Spu>::template BundleQueries<Traversal<Spu, kAccelerators>, Spu> {
  using Bundles = typename Strategy<Spu>::template BundleQueries<Traversal, Spu>;
  friend Bundles;

public:
  using S = typename Spu::simd;
  using F = typename S::F;

  Traversal(SceneAccess<Spu>& scene, const FrameBlock& frame)
      : Bundles(frame), frame_(frame), objects_(scene), grid_(objects_, frame.grid), bvh_(objects_, frame) {}

  /// Finds the closest hit of each ray in `lanes`; the `reflected` lanes come from a mirror. The results of
  /// other lanes are undefined.
  void find_closest(const RayPacket& rays, uint32_t lanes, HitPacket& hits, uint32_t reflected = 0) {
    RayQuery query = {&rays, &hits, nullptr, nullptr, lanes};
    objects_.set_reflected(reflected);
    intersect_packet(query);
    objects_.set_reflected(0);
  }

  /// Multiplies `light` of each ray in `lanes` by the transmittance between the ray's origin and `distance`:
  /// 0 if an opaque object occludes it, otherwise the product over the translucent surfaces that it crosses.
  /// The light of other lanes becomes 0.
  void transmittance(const RayPacket& rays, uint32_t lanes, const FloatLanes& distance, VectorLanes& light) {
    RayQuery query = {&rays, nullptr, &distance, &light, lanes};
    intersect_packet(query);
  }

  /// Shortens shadow rays to their first crossing with the projector of a light. Returns the lanes that cross
  /// the projector before the light; the light of the other lanes becomes 0.
  CELLTRACE_ONE_COPY uint32_t project(const LightRecord& light, const RayPacket& rays, uint32_t lanes,
                                      FloatLanes& distance, VectorLanes& colour) {
    HitPacket hits;
    RayQuery query = {&rays, &hits, nullptr, nullptr, lanes};
    reset_hits(&query, 1);
    objects_.test_list(light.projector, light.projector_count, query);
    const F at = F::load(hits.distance.lane), end = F::load(distance.lane);
    query = {&rays, nullptr, &distance, &colour, (at < end).bits() & lanes};
    S::min(at, end).store(distance.lane);
    clear_occluded(&query, 1);
    return query.lanes;
  }

  /// Answers all queries, at most one for each packet of a bundle, either all for hits or all for light. If
  /// the rays are coherent, this is faster than packet by packet. Not inlined, like intersect_packet(): local
  /// store has room for one copy of each.
  CELLTRACE_ONE_COPY void intersect(RayQuery* queries, uint32_t count) {
    reset_hits(queries, count);
    intersect_listed(queries, count);
    if constexpr (kHasBvh)
      if (searches_bvh()) bvh_.intersect(queries, count);
    if constexpr (kHasGrid)
      if (!uses_bvh()) intersect_grid(queries, count);
    clear_occluded(queries, count);
  }

  /// Answers one query, which needs no code for bundles.
  CELLTRACE_ONE_COPY void intersect_packet(RayQuery& query) {
    reset_hits(&query, 1);
    intersect_listed(&query, 1);
    if constexpr (kHasBvh)
      if (searches_bvh()) bvh_.intersect(query);
    if constexpr (kHasGrid)
      if (!uses_bvh()) intersect_grid(&query, 1);
    clear_occluded(&query, 1);
  }

  /// Answers queries of shadow rays toward one light. May change the order of the queries.
  void intersect(RayQuery* queries, uint32_t count, const LightRecord& light) {
    if (!Bundles::intersect_toward(queries, count, light)) intersect(queries, count);
  }

  ObjectTests<Spu>& objects() { return objects_; }
  const TraversalCounters& counters() const { return objects_.counters(); }
  void begin_frame() { objects_.begin_frame(); }

private:
  static constexpr bool kHasGrid = (kAccelerators & kGridOnly) != 0,
                        kHasBvh = (kAccelerators & kBvhOnly) != 0;

  void intersect_grid(RayQuery* queries, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      RayQuery& query = queries[i];
      if (query.hits != nullptr)
        grid_.find_closest(*query.rays, query.lanes, *query.hits);
      else
        query.lanes = grid_.transmittance(*query.rays, query.lanes, *query.distance, *query.light);
    }
  }

  CELLTRACE_ONE_COPY static void reset_hits(const RayQuery* queries, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      HitPacket* const hits = queries[i].hits;
      if (hits == nullptr) continue;
      Strategy<Spu>::template farthest<S>(queries[i].lanes).store(hits->distance.lane);
      store_words<S>(hits->object, S::I::splat(-1));
    }
  }
  /// Tests the objects that are in no accelerator, and all others if they are few.
  void intersect_listed(RayQuery* queries, uint32_t count) {
    if (frame_.unbounded_count != 0 || Bundles::lists_all()) test_listed(queries, count);
  }
  CELLTRACE_ONE_COPY void test_listed(RayQuery* queries, uint32_t count) {
    const uint32_t others = Bundles::lists_all() ? frame_.object_count : 0;
    for (uint32_t i = 0; i < count; ++i)
      objects_.test_unbounded(frame_, queries[i], others);
  }

  /// Sets the light of a query to 0 in lanes that are occluded or were not in the query.
  CELLTRACE_ONE_COPY static void clear_occluded(const RayQuery* queries, uint32_t count) {
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    for (uint32_t i = 0; i < count; ++i) {
      const RayQuery& query = queries[i];
      if (query.light == nullptr) continue;
      query.light->template store<S>(
          select<S>(S::M::from_bits(query.lanes), query.light->template load<S>(), dark));
    }
  }
  bool searches_bvh() const { return uses_bvh() && !Bundles::lists_all(); }
  bool uses_bvh() const {
    if constexpr (kAccelerators != kAnyAccelerator) return kHasBvh;
    return static_cast<AcceleratorKind>(frame_.accelerator) == AcceleratorKind::bvh;
  }

  const FrameBlock& frame_;
  ObjectTests<Spu> objects_;
  Present<GridTraversal<Spu>, kHasGrid> grid_;
  Present<BvhTraversal<Spu>, kHasBvh> bvh_;
};

} // namespace celltrace::kernel
