// Ray queries in direct memory: for bundles that pass through one point, and for area lights. Kernel dialect.
#pragma once

#include "kernel/accel/traversal.hpp"
#include "kernel/direct/area_occluders.hpp"
#include "kernel/direct/bundle_steps.hpp"

namespace celltrace::kernel {

/// Extends Traversal, which is the template parameter `Traversal`.
template <class Traversal, class Spu> class DirectBundleQueries {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  /// Answers a query of shadow rays whose light is a CrossingList: keeps the surfaces that the rays cross,
  /// without their transmittance if `lists`. The light of lanes for which there is no room becomes 0.
  void collect_crossings(RayQuery& query, bool lists) {
    keep(lists, [&] { traversal().intersect_packet(query); });
  }
  /// Keeps the crossings of several queries toward one light. May change the order of the queries.
  void collect_crossings(RayQuery* queries, uint32_t count, const LightRecord& light, bool lists) {
    keep(lists, [&] { traversal().intersect(queries, count, light); });
  }

  /// Gathers the possible occluders between a packet's surfaces and an area light.
  typename AreaOccluders<Spu>::Gathered gather_occluders(const RayPacket& rays, uint32_t lanes,
                                                         const LightRecord& light,
                                                         AreaOccluders<Spu>& occluders) {
    using Gathered = typename AreaOccluders<Spu>::Gathered;
    if (!traversal().uses_bvh()) return Gathered::nothing;
    const Gathered known = occluders.gather(traversal().objects_, traversal().frame_, rays, lanes, light);
    return known == Gathered::nodes && lists_all() ? Gathered::nothing : known;
  }
  /// Multiplies `light` as transmittance() does, if the nodes in which rays may hit something are known.
  void transmittance_of(const AreaOccluders<Spu>& occluders, const RayPacket& rays, uint32_t lanes,
                        const FloatLanes& distance, VectorLanes& light) {
    RayQuery query = {&rays, nullptr, &distance, &light, lanes};
    traversal().intersect_listed(&query, 1);
    traversal().bvh_.intersect_leaves(query, occluders.nodes(), occluders.node_count());
    traversal().clear_occluded(&query, 1);
  }
  /// Removes lanes from queries of shadow rays that cross one of the occluders, which must be opaque.
  void test_occluders(RayQuery* queries, uint32_t count, const AreaOccluders<Spu>& occluders) {
    occluders.test(traversal().objects_, queries, count);
  }

  /// Sets whether opaque objects that occlude rays are kept in the shadow cache.
  void record_occluders(bool recording) { traversal().objects_.record_occluders(recording); }
  /// Returns the `lanes` that cross none of the objects in the shadow cache; `light` is unchanged.
  uint32_t unoccluded_by_recent(const RayPacket& rays, uint32_t lanes, const FloatLanes& distance,
                                VectorLanes& light) {
    RayQuery query = {&rays, nullptr, &distance, &light, lanes};
    traversal().objects_.test_shadow_cache(query);
    return query.lanes;
  }

  /// Finds the closest hits of an application's packets with the BVH, up to the distances in `hits`, which
  /// have no object yet. No query may be without lanes. enter() must have been called last for `bundle`,
  /// which consists of these packets.
  void find_closest_within(RayQuery* queries, uint32_t count, const OriginBundle<S>& bundle) {
    traversal().intersect_listed(queries, count);
    if (!lists_all()) traversal().bvh_.intersect_from_origin(queries, count, bundle);
  }

  /// Answers queries as intersect() does, for rays that may all start at one point. May change the order of
  /// the queries.
  void intersect_from_origin(RayQuery* queries, uint32_t count) {
    if constexpr (Traversal::kHasBvh) {
      if (traversal().searches_bvh()) {
        traversal().reset_hits(queries, count);
        traversal().intersect_listed(queries, count);
        const uint32_t with_rays = queries_with_rays(queries, count);
        if (with_rays == 0) return;
        const OriginBundle<S> bundle(queries, with_rays);
        if (bundle.packets != 0) traversal().bvh_.enter(bundle);
        return traversal().bvh_.intersect_from_origin(queries, with_rays, bundle);
      }
    }
    traversal().intersect(queries, count);
  }

  /// Starts the traversal for a bundle of rays from one point. Returns false if no ray can hit anything.
  template <class Bundle> bool enter(const Bundle& bundle) {
    if constexpr (Traversal::kHasBvh)
      return !traversal().uses_bvh() || bundle.packets == 0 ||
             (lists_all() && traversal().frame_.unbounded_count != 0) || traversal().bvh_.enter(bundle) ||
             traversal().frame_.unbounded_count != 0;
    else
      return true;
  }
  /// Finds the closest hits of `bundle`, for which enter() was called last; query i belongs to packet i.
  void intersect_from_pinhole(RayQuery* queries, const PinholeBundle<S>& bundle) {
    if (!traversal().searches_bvh() || bundle.packets == 0)
      return traversal().intersect(queries, kBundlePackets<Spu>);
    traversal().reset_hits(queries, kBundlePackets<Spu>);
    traversal().intersect_listed(queries, kBundlePackets<Spu>);
    if constexpr (Traversal::kHasBvh) traversal().bvh_.intersect_from_pinhole(queries, bundle);
  }

protected:
  bool intersect_toward(RayQuery* queries, uint32_t count, const LightRecord& light) {
    if constexpr (Traversal::kHasBvh) {
      if (traversal().searches_bvh() && !is_parallel(light)) {
        traversal().intersect_listed(queries, count);
        // Planes may occlude all rays of a packet, which a bundle must not contain then.
        const uint32_t with_rays =
            traversal().frame_.unbounded_count == 0 ? count : queries_with_rays(queries, count);
        if (with_rays != 0) traversal().bvh_.intersect_toward(queries, with_rays, light.location);
        traversal().clear_occluded(queries, count);
        return true;
      }
    }
    return false;
  }

protected:
  explicit DirectBundleQueries(const FrameBlock& frame)
      : has_few_(frame.object_count <= tuning::kMostListedObjects) {}

  bool lists_all() const { return has_few_ && traversal().uses_bvh(); }

private:
  using Translucency = typename ObjectTests<Spu>::Translucency;

  Traversal& traversal() { return static_cast<Traversal&>(*this); }
  const Traversal& traversal() const { return static_cast<const Traversal&>(*this); }

  template <class Run> void keep(bool lists, Run run) {
    traversal().objects_.set_translucency(lists ? Translucency::is_listed : Translucency::is_kept);
    run();
    traversal().objects_.set_translucency(Translucency::attenuates);
  }

  /// Moves queries with rays in front of queries without rays; returns the number of the former.
  static uint32_t queries_with_rays(RayQuery* queries, uint32_t count) {
    uint32_t with_rays = 0;
    for (uint32_t i = 0; i < count; ++i) {
      if (queries[i].lanes == 0) continue;
      const RayQuery query = queries[i];
      queries[i] = queries[with_rays];
      queries[with_rays++] = query;
    }
    return with_rays;
  }

  const bool has_few_; ///< true if there are few bounded objects
};

} // namespace celltrace::kernel
