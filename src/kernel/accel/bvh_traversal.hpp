// Traversal of the BVH with the packets of a bundle. Kernel dialect.
//
// Coherent packets are traversed together. The frustum of the bundle is tested against the four children of a
// node at once; each child that it hits is tested against the frusta of all packets at once, which lie in
// SIMD lanes. A node that few of the packets hit is traversed by each of these packets separately
// (PacketTraversal). Divergent packets do not join the bundle: each is traversed alone, in groups of similar
// rays.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/accel/bundle_frusta.hpp"
#include "kernel/accel/packet_traversal.hpp"

namespace celltrace::kernel {

/// Traverses the BVH with bundles. A strategy's BundleSteps have:
///
///   intersect_mixed(query)              traverses a packet with rays of several octants; false: not done
///   end_view()                          is called if the bundle's rays do not pass through one point
///   view()                              BundleView of the bundle if its rays pass through a point, else null
///   trusts_frusta()                     true if frusta suffice at leaves, without slab tests of rays
///   untrusted_at(child)                 packets whose rays are tested in spite of trusts_frusta()
///   set_own_frustum(packet, query, frustum)   sets the frustum of a packet that leaves its bundle
///   shortening(packet)                  ratio of distances in a packet's frustum to distances along its rays
///   LeafTests(objects, view)            type of the tests of the bundle's packets against leaves
///   add_leaf(tests, queries, leaf, packets)   tests or defers a leaf, and limits `packets` to those whose
///                                       results may have changed; false if it did neither
///   test_object(self, packets, queries)       tests an object of a leaf for which add_leaf() returned false
///   test_deferred(tests, queries, bundled)    tests deferred leaves, unless they can wait for the next one
template <class Spu> class BvhTraversal : public Strategy<Spu>::template BundleSteps<BvhTraversal<Spu>, Spu> {
  using Steps = typename Strategy<Spu>::template BundleSteps<BvhTraversal, Spu>;
  friend Steps;

public:
  using S = typename Spu::simd;
  using F = typename S::F;

  BvhTraversal(ObjectTests<Spu>& objects, const FrameBlock& frame)
      : Steps(frame), objects_(objects), bvh_(frame.bvh), packet_traversal_(objects, frame),
        object_count_(static_cast<float>(frame.object_count)),
        rays_of_frame_(static_cast<float>(frame.width * frame.height)) {}

  /// Answers the queries, at most one for each packet of a bundle. Hits must have been reset. Occluded lanes
  /// are removed from queries of shadow rays.
  void intersect(RayQuery* queries, uint32_t count) { intersect(queries, count, 0); }
  /// Answers one query.
  void intersect(RayQuery& query) {
    if (query.lanes != 0) intersect_packet(query);
  }

private:
  using Lanes = BundleLanes<S, kBundlePackets<Spu>>;
  using Stack = typename PacketTraversal<Spu>::Stack;

  NodeRef root() const { return {bvh_.node_offset, 0}; }

  /// Resets the stack to the root node for some packets.
  Stack& begin(uint32_t packets) {
    Stack& stack = packet_traversal_.stack();
    stack.shrink(0);
    stack.push(0, {root(), packets, 0.0f, 0});
    return stack;
  }

  // --- one packet ---

  /// Traverses a packet in groups of rays with similar directions in one octant, each with its own frustum.
  CELLTRACE_ONE_COPY void intersect_packet(RayQuery& query) {
    objects_.hit_filter().begin_packet();
    const RayPacket& rays = *query.rays;
    if (Steps::intersect_mixed(query)) return;
    RayGroup<S>& group = ray_groups_[0];
    uint32_t remaining = query.lanes;
    while (remaining != 0) {
      const uint32_t octant = octant_of(rays, static_cast<uint32_t>(__builtin_ctz(remaining)));
      uint32_t same = remaining & lanes_in_octant<S>(rays, octant);
      remaining &= ~same;
      // All rays of the octant are traversed together if they are coherent, otherwise blocks of 2x2 rays, and
      // divergent blocks ray by ray.
      uint32_t level = 0;
      while (same != 0) {
        const uint32_t subset = same & subset_of(level, static_cast<uint32_t>(__builtin_ctz(same)));
        objects_.scene().spu().compute(scalar_work::kFrustum);
        const RayBounds bounds = bounds_of<S>(rays, subset);
        if (bounds.direction_spread() > kMaxPacketSpread<Spu>) {
          ++level;
          continue;
        }
        if (level == 2) level = 1;
        same &= ~subset;
        if ((query.lanes & subset) == 0) continue;
        objects_.scene().spu().compute(scalar_work::kRaysOfPacket);
        group.rays.set(rays, octant);
        group.frustum.set(bounds, octant);
        packet_traversal_.traverse({&group, &query, subset, subset, root()}, SlabOrder(octant));
      }
    }
  }

  /// Returns the lanes that are grouped with `lane`: on level 0 the whole packet, on level 1 the block of 2x2
  /// rays, on level 2 the lane alone.
  static uint32_t subset_of(uint32_t level, uint32_t lane) {
    if (level == 0) return 0xFFFF;
    return level == 1 ? 0x33u << (lane & 0xAu) : 1u << lane;
  }

  // --- a bundle of packets ---

  /// Answers all queries except those of the packets in `answered`.
  void intersect(RayQuery* queries, uint32_t count, uint32_t answered) {
    uint32_t remaining = 0;
    for (uint32_t packet = 0; packet < count; ++packet)
      remaining |= static_cast<uint32_t>(queries[packet].lanes != 0) << packet;
    remaining &= ~answered;
    if (!is_single(remaining)) remaining &= ~intersect_bundle(queries, remaining);
    for_each_lane(remaining, [&](uint32_t packet) { intersect_packet(queries[packet]); });
  }

  /// Traverses together the packets whose rays all have similar directions in one octant. Returns these
  /// packets.
  uint32_t intersect_bundle(RayQuery* queries, uint32_t packets) {
    const RayQuery& first = queries[__builtin_ctz(packets)];
    const uint32_t octant = octant_of(*first.rays, static_cast<uint32_t>(__builtin_ctz(first.lanes)));
    RayBounds all = {};
    uint32_t bundled = 0;
    for_each_lane(packets, [&](uint32_t packet) {
      const RayQuery& query = queries[packet];
      objects_.scene().spu().compute(scalar_work::kFrustum);
      const RayBounds bounds = bounds_of<S>(*query.rays, query.lanes);
      if (!bounds.is_in(octant)) return;
      RayBounds extended = bounds;
      if (bundled != 0) extended.include(all);
      if (extended.direction_spread() > tuning::kMaxDirectionSpread) return;
      all = extended;
      bundled |= 1u << packet;
      misses_[packet] = 0;
      frusta_.set(packet, bounds, octant);
      tfar_[packet] = PacketTraversal<Spu>::tfar_of(query, query.lanes);
    });
    if (is_single(bundled)) return 0;
    bundle_frustum_.set(all, octant);
    Steps::end_view();
    set_max_split_packets(rays_of_frame_);
    octant_ = octant;
    begin(bundled);
    const SlabOrder order(octant);
    traverse_bundle(queries, order, order, bundled);
    return bundled;
  }

  /// Traverses the nodes on the stack with the frusta of the packets `bundled`. `order` is for slab tests of
  /// frusta, `ray_order` for slab tests of rays; the orders differ if frusta contain reversed rays.
  void traverse_bundle(RayQuery* queries, const SlabOrder& order, const SlabOrder& ray_order,
                       uint32_t bundled) {
    max_tfar_ = PacketTraversal<Spu>::kTfarSlack * kMaxHitDistance; // until the first leaf has been tested
    incoherent_ = 0;
    known_rays_ = known_frusta_ = 0;
    typename Steps::LeafTests leaves(objects_, Steps::view());
    BundleVisitor visitor = {*this, leaves, queries, order, ray_order, bundled};
    NodeRef ref = {};
    traverse_nodes(visitor, ref, false);
  }

  /// The traversal of a bundle, for traverse_nodes(). A node that few packets hit is traversed by each of
  /// these packets separately.
  struct BundleVisitor {
    BvhTraversal& traversal;
    typename Steps::LeafTests& leaves;
    RayQuery* const queries;
    const SlabOrder &order, &ray_order;
    const uint32_t bundled;
    uint32_t packets = 0; ///< packets that hit the node or leaf

    [[gnu::always_inline]] bool expand(NodeRef& ref) {
      return traversal.expand(queries, order, ray_order, packets, ref);
    }
    [[gnu::always_inline]] void test(const NodeRef& leaf) {
      traversal.intersect_leaf(leaves, leaf, packets, queries);
      traversal.max_tfar_ = Lanes::greatest_of(bundled, traversal.tfar_);
    }
    [[gnu::always_inline]] bool next(NodeRef& ref) {
      Stack& stack = traversal.packet_traversal_.stack();
      for (;;) {
        traversal.Steps::test_deferred(leaves, queries, bundled);
        if (stack.size() == 0) return false;
        const typename Stack::Entry& next = stack.pop();
        packets = next.lanes & traversal.within_tfar(next.enter);
        if (packets == 0) continue;
        if (next.rays == 0) {
          ref = next.ref;
          return true;
        }
        traversal.traverse_split(queries, ray_order, next);
        traversal.max_tfar_ = Lanes::greatest_of(bundled, traversal.tfar_);
      }
    }
    static constexpr bool pauses() { return false; }
  };

  /// Traverses the node of stack entry `first` with the one packet of the entry. If interleaving pays, the
  /// next entries on the stack are traversed at the same time if each is of another single packet.
  CELLTRACE_ONE_COPY void traverse_split(RayQuery* queries, const SlabOrder& order,
                                         typename Stack::Entry first) {
    objects_.scene().spu().compute(scalar_work::kPacketAlone);
    typename PacketTraversal<Spu>::Task tasks[PacketTraversal<Spu>::kMaxInterleaved];
    tasks[0] = task_of(queries, first);
    uint32_t count = 1, packets = first.lanes;
    if (packet_traversal_.interleaves()) {
      Stack& stack = packet_traversal_.stack();
      while (count < PacketTraversal<Spu>::kMaxInterleaved && stack.size() != 0) {
        const typename Stack::Entry& next = stack.top();
        if (next.rays == 0 || (next.lanes & packets) != 0) break;
        stack.pop();
        if ((next.lanes & within_tfar(next.enter)) == 0) continue;
        tasks[count++] = task_of(queries, next);
        packets |= next.lanes;
      }
    }
    if (count == 1) {
      objects_.hit_filter().begin_packet();
      packet_traversal_.traverse(tasks[0], order);
    } else {
      packet_traversal_.traverse_interleaved(tasks, count, order);
    }
    update_tfar(packets, queries);
  }
  /// Returns the task of a stack entry for one packet. Sets the packet's frustum on first use.
  typename PacketTraversal<Spu>::Task task_of(RayQuery* queries, const typename Stack::Entry& entry) {
    const auto packet = static_cast<uint32_t>(__builtin_ctz(entry.lanes));
    RayQuery& query = queries[packet];
    if ((known_frusta_ & entry.lanes) == 0) {
      Steps::set_own_frustum(packet, query, ray_groups_[packet].frustum);
      known_frusta_ |= entry.lanes;
    }
    return {&ray_groups_[packet], &query, query.lanes, entry.rays, entry.ref};
  }

  /// Returns the rays of a packet, which are prepared for slab tests on first use.
  const OctantRays<S>& rays_of(const RayQuery& query, uint32_t packet) {
    if ((known_rays_ & (1u << packet)) == 0) {
      objects_.scene().spu().compute(scalar_work::kRaysOfPacket);
      ray_groups_[packet].rays.set(*query.rays, octant_);
      known_rays_ |= 1u << packet;
    }
    return ray_groups_[packet].rays;
  }

  /// Intersects the children of node `ref` with the frusta of packets; see PacketTraversal::expand(). Rays
  /// are tested only for leaves, for packets that split from the bundle, and for incoherent packets.
  bool expand(const RayQuery* queries, const SlabOrder& order, const SlabOrder& ray_order, uint32_t packets,
              NodeRef& ref) {
    objects_.scene().spu().compute(scalar_work::kBvhNode);
    ++objects_.counters().visits;
    const NodeRecord& node = *objects_.scene().node(ref.child);
    alignas(16) float enter[4];
    uint32_t hit = bundle_frustum_.intersect(node.bounds, order, max_tfar_, enter);
    if (hit == 0) return false;
    if (is_single(hit)) {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(hit));
      if (node.leaf[i] == 0) {
        ref = {node.child[i], 0};
        return true;
      }
    }
    Stack& stack = packet_traversal_.stack();
    const uint32_t first = stack.size();
    do {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(hit));
      hit &= hit - 1;
      objects_.scene().spu().compute(scalar_work::kBvhChild);
      uint32_t lanes = frusta_.intersect(node.bounds, order, i, tfar_) & packets;
      const NodeRef child = {node.child[i], node.leaf[i]};
      const bool tests_rays = (child.is_leaf() && !Steps::trusts_frusta()) || should_split(lanes);
      if (lanes == 0) continue;
      objects_.scene().hint(child);
      lanes &= ~packets_that_miss(node.bounds, ray_order, i, queries,
                                  tests_rays ? lanes : lanes & (incoherent_ | Steps::untrusted_at(child)));
      if (tests_rays && !child.is_leaf())
        for_each_lane(lanes, [&](uint32_t packet) {
          stack.push(first, {child, 1u << packet, enter[i], hit_rays_[packet]});
        });
      else if (lanes != 0)
        stack.push(first, {child, lanes, enter[i], 0});
    } while (hit != 0);
    return false;
  }

  /// Sets how many packets may split: kMaxSplitPackets if triangles are probably smaller than the gaps
  /// between the picture's `rays`, otherwise one.
  void set_max_split_packets(float rays) {
    constexpr uint32_t kMost = PacketTraversal<Spu>::kMaxSplitPackets;
    if constexpr (kMost != 1)
      max_split_packets_ = object_count_ * float{tuning::kPixelsOfSmallObject} <= rays ? 1 : kMost;
  }
  /// Returns true if the packets that hit a node traverse it separately.
  bool should_split(uint32_t packets) const {
    if constexpr (PacketTraversal<Spu>::kMaxSplitPackets == 1) return is_single(packets);
    return static_cast<uint32_t>(__builtin_popcount(packets)) <= max_split_packets_;
  }

  /// Returns the packets without a ray that hits child `i`. Stores the rays that hit the child in hit_rays_.
  uint32_t packets_that_miss(const float (&bounds)[6][4], const SlabOrder& order, uint32_t i,
                             const RayQuery* queries, uint32_t packets) {
    uint32_t missing = 0;
    for_each_lane(packets, [&](uint32_t packet) {
      const RayQuery& query = queries[packet];
      objects_.scene().spu().compute(scalar_work::kRaysAgainstBounds);
      const uint32_t rays =
          rays_of(query, packet).intersect(bounds, order, i, PacketTraversal<Spu>::tfar(query)) & query.lanes;
      hit_rays_[packet] = rays;
      const uint32_t missed = static_cast<uint32_t>(rays == 0);
      missing |= missed << packet;
      misses_[packet] += missed;
      incoherent_ |= static_cast<uint32_t>(misses_[packet] >= tuning::kMissesOfIncoherent) << packet;
    });
    return missing;
  }

  void intersect_leaf(typename Steps::LeafTests& leaves, const NodeRef& leaf, uint32_t packets,
                      RayQuery* queries) {
    if (!Steps::add_leaf(leaves, queries, leaf, packets))
      objects_.scene().for_each_object(leaf, [&](uint32_t self) {
        Steps::test_object(self, packets, queries);
        return false;
      });
    update_tfar(packets, queries);
  }

  void update_tfar(uint32_t packets, const RayQuery* queries) {
    for_each_lane(packets, [&](uint32_t packet) { update_tfar(queries[packet], packet); });
  }
  /// Updates the tfar of a packet. A packet whose rays are all occluded gets a negative tfar, so that it hits
  /// no further node.
  void update_tfar(const RayQuery& query, uint32_t packet) {
    if (query.hits != nullptr)
      tfar_[packet] = PacketTraversal<Spu>::tfar_of(query, query.lanes) * Steps::shortening(packet);
    else if (query.lanes == 0)
      tfar_[packet] = -1.0f;
  }
  uint32_t within_tfar(float distance) const {
    return Lanes::at_most(Lanes::splat(distance), Lanes::Type::load(tfar_));
  }

  ObjectTests<Spu>& objects_;
  const BvhRecord& bvh_;
  PacketTraversal<Spu> packet_traversal_;
  const float object_count_, rays_of_frame_;
  uint32_t max_split_packets_ = 1;              ///< limit for the current bundle
  RayGroup<S> ray_groups_[kBundlePackets<Spu>]; ///< index: packet; intersect_packet() uses the first
  BundleFrusta<S, kBundlePackets<Spu>> frusta_;
  Frustum<S> bundle_frustum_;              ///< contains all of frusta_
  uint32_t hit_rays_[kBundlePackets<Spu>]; ///< index: packet; rays that hit the child that was tested last
  uint32_t misses_[kBundlePackets<Spu>];   ///< index: packet; nodes hit by its frustum but by no ray
  uint32_t incoherent_ = 0;                ///< packets whose frusta hit nodes in vain
  float max_tfar_ = 0.0f;                  ///< maximum of tfar_
  uint32_t octant_ = 0;                    ///< octant of all rays of the bundle
  uint32_t known_rays_ = 0, known_frusta_ = 0; ///< packets whose rays or frusta in ray_groups_ are set
  /// Greatest distance of each packet, measured in its frustum. Negative: the packet hits nothing.
  alignas(64) float tfar_[kBundlePackets<Spu>] = {};
};

} // namespace celltrace::kernel
