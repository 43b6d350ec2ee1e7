// Packets through the BVH, alone or as a bundle. Kernel dialect.
//
// The packets of a bundle whose rays have much in common go together: a beam around all of them is tested
// against a node's boxes, and what it meets against the packets' own beams, a lane each. What only one of the
// packets meets, it tasks alone (PacketTraversal); so do packets whose rays go different ways, in parts.
#pragma once

#include "kernel/accel/packet_traversal.hpp"
#include "kernel/direct/bundle_leaf_tests.hpp"
#include "kernel/direct/light_bundle.hpp"
#include "kernel/cameras/primary_rays.hpp"

namespace celltrace::kernel {

template <class Spu> class BvhTraversal {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  BvhTraversal(ObjectTests<Spu>& objects, const FrameBlock& frame)
      : objects_(objects), bvh_(frame.bvh), packets_(objects, frame),
        most_alone_(most_alone(frame)) {}

  /// Answers each of the queries, at most a bundle's. Hits hold none yet; the lanes of queries for light
  /// become those to which some comes.
  void intersect(RayQuery* queries, uint32_t count) { intersect(queries, count, 0); }
  /// The same of the hits of a bundle's primary rays, which was entered just before; query i is of its
  /// packet i.
  void intersect(RayQuery* queries, const PinholeBundle<S>& bundle) {
    for (uint32_t packet = 0; packet < kBundlePackets<Spu>; ++packet)
      tfar_[packet] = queries[packet].lanes != 0 ? PacketTraversal<Spu>::kTfarSlack * kMaxHitDistance : -1.0f;
    bundle.shortening.store(shortening_);
    traverse_together(queries, bundle);
  }
  /// The same of queries, all with some lanes, for the light that comes from one place.
  void intersect(RayQuery* queries, uint32_t count, const float (&light)[3]) {
    const LightBundle<S> bundle(light, queries, count);
    if (bundle.packets != 0) {
      (bundle.reach * F(PacketTraversal<Spu>::kTfarSlack)).store(tfar_);
      begin(bundle.packets);
      traverse_together(queries, bundle);
    }
    intersect(queries, count, bundle.packets);
  }

  /// Sends a bundle's beam through the BVH until it comes to a leaf or has opened a few nodes. False:
  /// it left without; otherwise intersect() goes on from there.
  bool enter(const PinholeBundle<S>& bundle) {
    constexpr uint32_t kMostNodes = 24;
    const SlabOrder sides(bundle.octant);
    around_.set(bundle.all, bundle.octant);
    Stack& stack = begin(bundle.packets);
    for (uint32_t nodes = 0; stack.size() != 0; ++nodes) {
      const typename Stack::Entry next = stack.pop();
      if (next.ref.is_leaf() || nodes == kMostNodes) {
        stack.push(stack.size(), next);
        return true;
      }
      ++objects_.counters().visits;
      const NodeRecord& node = *objects_.scene().node(next.ref.child);
      alignas(16) float distance[4];
      const uint32_t first = stack.size();
      for_each_lane(around_.intersect(node.bounds, sides, kMaxHitDistance, distance), [&](uint32_t i) {
        const NodeRef child = {node.child[i], node.leaf[i]};
        objects_.scene().hint(child);
        stack.push(first, {child, bundle.packets, distance[i], 0});
      });
    }
    return false;
  }

private:
  using Lanes = BundleLanes<S, kBundlePackets<Spu>>;
  using Stack = typename PacketTraversal<Spu>::Stack;

  /// A packet's beam is loose once it has hit this many boxes that none of its rays meet: where surfaces
  /// begin and end, shadow rays leave from places far apart.
  static constexpr uint32_t kMissesOfLoose = 2;

  NodeRef root() const { return {bvh_.node_offset, 0}; }

  /// Nothing but the root, for these packets, on the stack.
  Stack& begin(uint32_t packets) {
    Stack& stack = packets_.stack();
    stack.shrink(0);
    stack.push(0, {root(), packets, 0.0f, 0});
    return stack;
  }

  // --- packets alone ---

  /// Splits the lanes into beams, and sends each through the BVH.
  void intersect_alone(RayQuery& query) {
    objects_.hit_filter().begin_packet();
    const RayPacket& rays = *query.rays;
    RayGroup<S>& group = members_[0];
    uint32_t left = query.lanes;
    while (left != 0) {
      const uint32_t octant = octant_of(rays, static_cast<uint32_t>(__builtin_ctz(left)));
      uint32_t same = left & lanes_in_octant(rays, octant);
      left &= ~same;
      // First all of them; if they have little in common, four neighbours at a time, or one.
      uint32_t parts = 0;
      while (same != 0) {
        const uint32_t part = same & part_of(parts, static_cast<uint32_t>(__builtin_ctz(same)));
        objects_.scene().spu().compute(scalar_work::kFrustum);
        const RayBounds bounds = bounds_of<S>(rays, part);
        if (bounds.direction_spread() > kMaxDirectionSpread) {
          ++parts;
          continue;
        }
        if (parts == 2) parts = 1;
        same &= ~part;
        if ((query.lanes & part) == 0) continue;
        objects_.scene().spu().compute(scalar_work::kRaysOfPacket);
        group.rays.set(rays, octant);
        group.frustum.set(bounds, octant);
        packets_.traverse({&group, &query, part, part, root()}, SlabOrder(octant));
      }
    }
  }

  /// The lanes that go with `lane` when a packet is taken whole (0), in blocks of 2x2 (1) or apart (2).
  static uint32_t part_of(uint32_t parts, uint32_t lane) {
    if (parts == 0) return 0xFFFF;
    return parts == 1 ? 0x33u << (lane & 0xAu) : 1u << lane;
  }

  static uint32_t lanes_in_octant(const RayPacket& rays, uint32_t octant) {
    const F zero(0.0f);
    const V3<S> direction = rays.direction.template load<S>();
    const uint32_t x = (direction.x < zero).bits(), y = (direction.y < zero).bits(),
                   z = (direction.z < zero).bits();
    const auto same = [](uint32_t negative, uint32_t wanted) { return wanted != 0 ? negative : ~negative; };
    return same(x, octant & 1) & same(y, octant & 2) & same(z, octant & 4);
  }

  // --- packets together ---

  /// All but `answered` queries.
  void intersect(RayQuery* queries, uint32_t count, uint32_t answered) {
    uint32_t left = 0;
    for (uint32_t packet = 0; packet < count; ++packet)
      left |= static_cast<uint32_t>(queries[packet].lanes != 0) << packet;
    left &= ~answered;
    if (!is_single(left)) left &= ~intersect_together(queries, left);
    for_each_lane(left, [&](uint32_t packet) { intersect_alone(queries[packet]); });
  }

  /// Those of the packets whose rays have enough in common go through the BVH together. Returns which
  /// did.
  uint32_t intersect_together(RayQuery* queries, uint32_t packets) {
    const RayQuery& some = queries[__builtin_ctz(packets)];
    const uint32_t octant = octant_of(*some.rays, static_cast<uint32_t>(__builtin_ctz(some.lanes)));
    RayBounds all = {};
    uint32_t together = 0;
    for_each_lane(packets, [&](uint32_t packet) {
      const RayQuery& query = queries[packet];
      objects_.scene().spu().compute(scalar_work::kFrustum);
      const RayBounds bounds = bounds_of<S>(*query.rays, query.lanes);
      if (!bounds.is_in(octant)) return;
      RayBounds more = bounds;
      if (together != 0) more.include(all);
      if (more.direction_spread() > kMaxDirectionSpread) return;
      all = more;
      together |= 1u << packet;
      misses_[packet] = 0;
      frusta_.set(packet, bounds, octant);
      tfar_[packet] = PacketTraversal<Spu>::tfar_of(query, query.lanes);
    });
    if (is_single(together)) return 0;
    around_.set(all, octant);
    view_ = nullptr;
    octant_ = octant;
    turned_ = false;
    begin(together);
    const SlabOrder sides(octant);
    traverse_together(queries, sides, sides, together);
    return together;
  }

  /// By a bundle's beams.
  void traverse_together(RayQuery* queries, const ViewBundle<S>& bundle) {
    for (uint32_t& misses : misses_)
      misses = 0;
    frusta_.set(bundle.bounds, bundle.octant);
    around_.set(bundle.all, bundle.octant);
    view_ = &bundle.view;
    octant_ = bundle.turned ? bundle.octant ^ 7 : bundle.octant;
    turned_ = bundle.turned;
    traverse_together(queries, SlabOrder(bundle.octant), SlabOrder(octant_), bundle.packets);
  }
  /// By their beams, which enter and leave boxes by `sides`; the rays themselves do by `ray_sides`. What is
  /// to be visited is on the stack.
  void traverse_together(RayQuery* queries, const SlabOrder& sides, const SlabOrder& ray_sides, uint32_t together) {
    max_tfar_ = PacketTraversal<Spu>::kTfarSlack * kMaxHitDistance; // until there are hits
    loose_ = 0;
    known_rays_ = known_frusta_ = 0;
    Stack& stack = packets_.stack();
    BundleLeafTests<Spu> leaves(objects_);
    for (;;) {
      if (!defers_more(leaves)) test_deferred(leaves, queries, together);
      if (stack.size() == 0) break;
      const typename Stack::Entry& next = stack.pop();
      const uint32_t packets = next.lanes & within_tfar(next.enter);
      if (packets == 0) continue;
      if (next.rays != 0) {
        traverse_alone(queries, ray_sides, next);
      } else {
        NodeRef ref = next.ref;
        while (!ref.is_leaf() && expand(queries, sides, ray_sides, packets, ref)) {
        }
        if (!ref.is_leaf()) continue;
        intersect_leaf(leaves, ref, packets, queries);
      }
      max_tfar_ = Lanes::greatest_of(together, tfar_);
    }
  }

  /// Packets that go alone to branches: `first`, and others that are next on the stack if they take turns.
  [[gnu::noinline]] void traverse_alone(RayQuery* queries, const SlabOrder& sides, typename Stack::Entry first) {
    objects_.scene().spu().compute(scalar_work::kPacketAlone);
    typename PacketTraversal<Spu>::Task tasks[PacketTraversal<Spu>::kMostInterleaved];
    tasks[0] = task_of(queries, first);
    uint32_t count = 1, packets = first.lanes;
    if (Spu::direct_memory && packets_.interleaves()) {
      Stack& stack = packets_.stack();
      while (count < PacketTraversal<Spu>::kMostInterleaved && stack.size() != 0) {
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
      packets_.traverse(tasks[0], sides);
    } else {
      packets_.traverse_interleaved(tasks, count, sides);
    }
    update_tfar(packets, queries);
  }
  /// Of an entry for one packet.
  typename PacketTraversal<Spu>::Task task_of(RayQuery* queries, const typename Stack::Entry& entry) {
    const auto packet = static_cast<uint32_t>(__builtin_ctz(entry.lanes));
    RayQuery& query = queries[packet];
    if ((known_frusta_ & entry.lanes) == 0) {
      if (Spu::direct_memory && turned_)
        members_[packet].frustum.set(bounds_of<S>(*query.rays, query.lanes), octant_);
      else
        frusta_.get(packet, members_[packet].frustum);
      known_frusta_ |= entry.lanes;
    }
    return {&members_[packet], &query, query.lanes, entry.rays, entry.ref};
  }

  const OctantRays<S>& rays_of(const RayQuery& query, uint32_t packet) {
    if ((known_rays_ & (1u << packet)) == 0) {
      objects_.scene().spu().compute(scalar_work::kRaysOfPacket);
      members_[packet].rays.set(*query.rays, octant_);
      known_rays_ |= 1u << packet;
    }
    return members_[packet].rays;
  }

  /// As PacketTraversal's, with the packets' beams in place of rays. The rays themselves are asked where objects
  /// are and where beams are loose.
  bool expand(const RayQuery* queries, const SlabOrder& sides, const SlabOrder& ray_sides, uint32_t packets,
            NodeRef& ref) {
    objects_.scene().spu().compute(scalar_work::kBvhNode);
    ++objects_.counters().visits;
    const NodeRecord& node = *objects_.scene().node(ref.child);
    alignas(16) float enter[4];
    uint32_t hit = around_.intersect(node.bounds, sides, max_tfar_, enter);
    if (hit == 0) return false;
    if (is_single(hit)) {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(hit));
      if (node.leaf[i] == 0) {
        ref = {node.child[i], 0};
        return true;
      }
    }
    Stack& stack = packets_.stack();
    const uint32_t first = stack.size();
    do {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(hit));
      hit &= hit - 1;
      objects_.scene().spu().compute(scalar_work::kBvhChild);
      uint32_t lanes = frusta_.intersect(node.bounds, sides, i, tfar_) & packets;
      const NodeRef child = {node.child[i], node.leaf[i]};
      const bool ask_all = (child.is_leaf() && !trusts_beams()) || is_lonely(lanes);
      if (lanes == 0) continue;
      objects_.scene().hint(child);
      lanes &= ~packets_that_miss(node.bounds, ray_sides, i, queries, ask_all ? lanes : lanes & loose_);
      if (ask_all && !child.is_leaf())
        for_each_lane(lanes, [&](uint32_t packet) {
          stack.push(first, {child, 1u << packet, enter[i], rays_[packet]});
        });
      else if (lanes != 0)
        stack.push(first, {child, lanes, enter[i], 0});
    } while (hit != 0);
    return false;
  }

  /// Beams through one point are hardly larger than their rays; but where an object has to be fetched, that
  /// takes longer than asking them.
  bool trusts_beams() const { return Spu::direct_memory && view_ != nullptr; }
  /// Where objects are small beside pixels, the packets of a bundle part early.
  static uint32_t most_alone(const FrameBlock& frame) {
    constexpr uint32_t kMost = PacketTraversal<Spu>::kMostAlone;
    return kMost == 1 || frame.object_count <= frame.width * frame.height / 2 ? 1 : kMost;
  }
  bool is_lonely(uint32_t packets) const {
    if constexpr (PacketTraversal<Spu>::kMostAlone == 1) return is_single(packets);
    return static_cast<uint32_t>(__builtin_popcount(packets)) <= most_alone_;
  }

  /// Those of the packets that have no ray that meets the box; the others' rays that do go to rays_.
  uint32_t packets_that_miss(const float (&bounds)[6][4], const SlabOrder& sides, uint32_t i,
                           const RayQuery* queries, uint32_t packets) {
    uint32_t without = 0;
    for_each_lane(packets, [&](uint32_t packet) {
      const RayQuery& query = queries[packet];
      objects_.scene().spu().compute(scalar_work::kRaysAgainstBounds);
      const uint32_t rays =
          rays_of(query, packet).intersect(bounds, sides, i, PacketTraversal<Spu>::tfar(query)) & query.lanes;
      rays_[packet] = rays;
      const uint32_t missed = static_cast<uint32_t>(rays == 0);
      without |= missed << packet;
      misses_[packet] += missed;
      loose_ |= static_cast<uint32_t>(misses_[packet] >= kMissesOfLoose) << packet;
    });
    return without;
  }

  void intersect_leaf(BundleLeafTests<Spu>& leaves, const NodeRef& leaf, uint32_t packets, RayQuery* queries) {
    uint32_t changed = packets;
    if (Spu::direct_memory && view_ != nullptr && !is_single(packets))
      changed = leaves.add(queries, packets, leaf);
    else
      objects_.scene().for_each_object(leaf, [&](uint32_t self) {
        test_object(self, packets, queries);
        return false;
      });
    update_tfar(changed, queries);
  }
  /// Before a node is opened, what lies in leaves should be known.
  bool defers_more(const BundleLeafTests<Spu>& leaves) {
    if (!Spu::direct_memory || !leaves.has_deferred()) return true;
    const Stack& stack = packets_.stack();
    return stack.size() != 0 && stack.top().ref.is_leaf() && leaves.has_room_for(stack.top().ref);
  }
  void test_deferred(BundleLeafTests<Spu>& leaves, RayQuery* queries, uint32_t together) {
    update_tfar(leaves.test(queries, *view_), queries);
    max_tfar_ = Lanes::greatest_of(together, tfar_);
  }
  void test_object(uint32_t self, uint32_t packets, RayQuery* queries) {
    if constexpr (Spu::direct_memory) {
      if (queries[__builtin_ctz(packets)].hits != nullptr)
        objects_.test_closest_of_all(queries, packets, self);
      else
        objects_.test_occlusion_of_all(queries, packets, self);
      return;
    }
    for_each_lane(packets, [&](uint32_t packet) {
      RayQuery& query = queries[packet];
      if (query.hits != nullptr) {
        objects_.test_closest(*query.rays, self, *query.hits);
      } else if (query.lanes != 0) {
        objects_.hit_filter().begin_packet();
        query.lanes &= ~objects_.occluded(*query.rays, self, query.lanes, *query.distance, *query.light);
      }
    });
  }

  void update_tfar(uint32_t packets, const RayQuery* queries) {
    for_each_lane(packets, [&](uint32_t packet) { update_tfar(queries[packet], packet); });
  }
  /// A packet that no light comes to any more looks nowhere.
  void update_tfar(const RayQuery& query, uint32_t packet) {
    if (query.hits != nullptr)
      tfar_[packet] = PacketTraversal<Spu>::tfar_of(query, query.lanes) * shortening(packet);
    else if (query.lanes == 0)
      tfar_[packet] = -1.0f;
  }
  /// By which distances along a packet's rays are multiplied to get those along its beam.
  float shortening([[maybe_unused]] uint32_t packet) const {
    if constexpr (Spu::direct_memory) return view_ != nullptr ? shortening_[packet] : 1.0f;
    return 1.0f;
  }
  uint32_t within_tfar(float distance) const {
    return Lanes::at_most(Lanes::splat(distance), Lanes::Type::load(tfar_));
  }

  ObjectTests<Spu>& objects_;
  const BvhRecord& bvh_;
  PacketTraversal<Spu> packets_;
  const uint32_t most_alone_;                ///< packets
  RayGroup<S> members_[kBundlePackets<Spu>]; ///< packets of the bundle; a packet alone is the first
  BundleFrusta<S, kBundlePackets<Spu>> frusta_;
  Frustum<S> around_;                                     ///< all of them
  uint32_t rays_[kBundlePackets<Spu>];                 ///< of each packet that was asked last
  uint32_t misses_[kBundlePackets<Spu>];               ///< boxes that a beam hit but no ray
  uint32_t loose_ = 0;                                 ///< packets
  float max_tfar_ = 0.0f;                              ///< no packet looks farther
  const BundleView<S>* view_ = nullptr;                ///< of theirs, if they go through one point
  uint32_t octant_ = 0;                                ///< of all rays that go together
  bool turned_ = false;                                ///< their beams go the other way
  uint32_t known_rays_ = 0, known_frusta_ = 0;          ///< packets of which members_ has them
  alignas(64) float tfar_[kBundlePackets<Spu>] = {}; ///< how far each packet looks along its beam
  /// Of each packet of primary rays, which go through one point.
  alignas(64) float shortening_[Spu::direct_memory ? kBundlePackets<Spu> : 1] = {};
};

} // namespace celltrace::kernel
