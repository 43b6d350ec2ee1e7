// Packets through the hierarchy of boxes, alone or several together. Kernel dialect.
//
// The packets of a bundle whose rays have much in common go together: a beam around all of them is tested
// against a node's boxes, and what it meets against the packets' own beams, a lane each. What only one of the
// packets meets, it visits alone (BranchWalk); so do packets whose rays go different ways, in parts.
#pragma once

#include "kernel/branch_walk.hpp"
#include "kernel/bundle_leaf_tests.hpp"
#include "kernel/light_bundle.hpp"
#include "kernel/primary_rays.hpp"

namespace celltrace::kernel {

template <class Spu> class HierarchyTraversal {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  HierarchyTraversal(ObjectTests<Spu>& objects, const FrameBlock& frame)
      : objects_(objects), hierarchy_(frame.hierarchy), walk_(objects, frame),
        most_alone_(most_alone(frame)) {}

  /// Answers each of the searches, at most a bundle's. Hits hold none yet; the lanes of searches for light
  /// become those to which some comes.
  void run(Search* searches, uint32_t count) { run(searches, count, 0); }
  /// The same of the hits of a bundle's primary rays, which was entered just before; search i is of its
  /// packet i.
  void run(Search* searches, const PinholeBundle<S>& bundle) {
    for (uint32_t packet = 0; packet < kBundlePackets<Spu>; ++packet)
      limits_[packet] = searches[packet].lanes != 0 ? BranchWalk<Spu>::kBeyond * kMaxHitDistance : -1.0f;
    bundle.shortening.store(shortening_);
    walk_together(searches, bundle);
  }
  /// The same of searches, all with some lanes, for the light that comes from one place.
  void run(Search* searches, uint32_t count, const float (&light)[3]) {
    const LightBundle<S> bundle(light, searches, count);
    if (bundle.packets != 0) {
      (bundle.reach * F(BranchWalk<Spu>::kBeyond)).store(limits_);
      begin(bundle.packets);
      walk_together(searches, bundle);
    }
    run(searches, count, bundle.packets);
  }

  /// Sends a bundle's beam through the hierarchy until it comes to a leaf or has opened a few nodes. False:
  /// it left without; otherwise run() goes on from there.
  bool enter(const PinholeBundle<S>& bundle) {
    constexpr uint32_t kMostNodes = 24;
    const BoxSides sides(bundle.octant);
    around_.set(bundle.all, bundle.octant);
    Stack& stack = begin(bundle.packets);
    for (uint32_t nodes = 0; stack.size() != 0; ++nodes) {
      const typename Stack::Entry next = stack.pop();
      if (next.branch.is_leaf() || nodes == kMostNodes) {
        stack.push(stack.size(), next);
        return true;
      }
      ++objects_.counters().voxels;
      const NodeRecord& node = *objects_.scene().node(next.branch.child);
      alignas(16) float distance[4];
      const uint32_t first = stack.size();
      for_each_lane(around_.meets(node.box, sides, kMaxHitDistance, distance), [&](uint32_t i) {
        const Branch child = {node.child[i], node.leaf[i]};
        objects_.scene().hint(child);
        stack.push(first, {child, bundle.packets, distance[i], 0});
      });
    }
    return false;
  }

private:
  using Lanes = BundleLanes<S, kBundlePackets<Spu>>;
  using Stack = typename BranchWalk<Spu>::Stack;

  /// A packet's beam is loose once it has met this many boxes that none of its rays meet: where surfaces
  /// begin and end, shadow rays leave from places far apart.
  static constexpr uint32_t kMissesOfLoose = 2;

  Branch root() const { return {hierarchy_.node_offset, 0}; }

  /// Nothing but the root, for these packets, on the stack.
  Stack& begin(uint32_t packets) {
    Stack& stack = walk_.stack();
    stack.shrink(0);
    stack.push(0, {root(), packets, 0.0f, 0});
    return stack;
  }

  // --- packets alone ---

  /// Splits the lanes into beams, and sends each through the hierarchy.
  void run_alone(Search& search) {
    objects_.mailbox().begin_packet();
    const RayPacket& rays = *search.rays;
    RayGroup<S>& group = members_[0];
    uint32_t left = search.lanes;
    while (left != 0) {
      const uint32_t octant = octant_of(rays, static_cast<uint32_t>(__builtin_ctz(left)));
      uint32_t same = left & lanes_in_octant(rays, octant);
      left &= ~same;
      // First all of them; if they have little in common, four neighbours at a time, or one.
      uint32_t parts = 0;
      while (same != 0) {
        const uint32_t part = same & part_of(parts, static_cast<uint32_t>(__builtin_ctz(same)));
        objects_.scene().spu().compute(scalar_work::kBeam);
        const RayBounds bounds = bounds_of<S>(rays, part);
        if (bounds.direction_spread() > kMaxDirectionSpread) {
          ++parts;
          continue;
        }
        if (parts == 2) parts = 1;
        same &= ~part;
        if ((search.lanes & part) == 0) continue;
        objects_.scene().spu().compute(scalar_work::kRaysOfPacket);
        group.rays.set(rays, octant);
        group.beam.set(bounds, octant);
        walk_.walk({&group, &search, part, part, root()}, BoxSides(octant));
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

  /// All but `answered` searches.
  void run(Search* searches, uint32_t count, uint32_t answered) {
    uint32_t left = 0;
    for (uint32_t packet = 0; packet < count; ++packet)
      left |= static_cast<uint32_t>(searches[packet].lanes != 0) << packet;
    left &= ~answered;
    if (!is_single(left)) left &= ~run_together(searches, left);
    for_each_lane(left, [&](uint32_t packet) { run_alone(searches[packet]); });
  }

  /// Those of the packets whose rays have enough in common go through the hierarchy together. Returns which
  /// did.
  uint32_t run_together(Search* searches, uint32_t packets) {
    const Search& some = searches[__builtin_ctz(packets)];
    const uint32_t octant = octant_of(*some.rays, static_cast<uint32_t>(__builtin_ctz(some.lanes)));
    RayBounds all = {};
    uint32_t together = 0;
    for_each_lane(packets, [&](uint32_t packet) {
      const Search& search = searches[packet];
      objects_.scene().spu().compute(scalar_work::kBeam);
      const RayBounds bounds = bounds_of<S>(*search.rays, search.lanes);
      if (!bounds.is_in(octant)) return;
      RayBounds more = bounds;
      if (together != 0) more.include(all);
      if (more.direction_spread() > kMaxDirectionSpread) return;
      all = more;
      together |= 1u << packet;
      misses_[packet] = 0;
      beams_.set(packet, bounds, octant);
      limits_[packet] = BranchWalk<Spu>::limit_of(search, search.lanes);
    });
    if (is_single(together)) return 0;
    around_.set(all, octant);
    view_ = nullptr;
    octant_ = octant;
    turned_ = false;
    begin(together);
    const BoxSides sides(octant);
    walk_together(searches, sides, sides, together);
    return together;
  }

  /// By a bundle's beams.
  void walk_together(Search* searches, const ViewBundle<S>& bundle) {
    for (uint32_t& misses : misses_)
      misses = 0;
    beams_.set(bundle.bounds, bundle.octant);
    around_.set(bundle.all, bundle.octant);
    view_ = &bundle.view;
    octant_ = bundle.turned ? bundle.octant ^ 7 : bundle.octant;
    turned_ = bundle.turned;
    walk_together(searches, BoxSides(bundle.octant), BoxSides(octant_), bundle.packets);
  }
  /// By their beams, which enter and leave boxes by `sides`; the rays themselves do by `ray_sides`. What is
  /// to be visited is on the stack.
  void walk_together(Search* searches, const BoxSides& sides, const BoxSides& ray_sides, uint32_t together) {
    farthest_ = BranchWalk<Spu>::kBeyond * kMaxHitDistance; // until there are hits
    loose_ = 0;
    known_rays_ = known_beams_ = 0;
    Stack& stack = walk_.stack();
    BundleLeafTests<Spu> leaves(objects_);
    for (;;) {
      if (!goes_on_with(leaves)) test_waiting(leaves, searches, together);
      if (stack.size() == 0) break;
      const typename Stack::Entry& next = stack.pop();
      const uint32_t packets = next.lanes & looking_as_far_as(next.enter);
      if (packets == 0) continue;
      if (next.rays != 0) {
        walk_alone(searches, ray_sides, next);
      } else {
        Branch branch = next.branch;
        while (!branch.is_leaf() && open(searches, sides, ray_sides, packets, branch)) {
        }
        if (!branch.is_leaf()) continue;
        meet(leaves, branch, packets, searches);
      }
      farthest_ = Lanes::greatest_of(together, limits_);
    }
  }

  /// Packets that go alone to branches: `first`, and others that are next on the stack if they take turns.
  [[gnu::noinline]] void walk_alone(Search* searches, const BoxSides& sides, typename Stack::Entry first) {
    objects_.scene().spu().compute(scalar_work::kPacketAlone);
    typename BranchWalk<Spu>::Visit visits[BranchWalk<Spu>::kMostInTurn];
    visits[0] = visit_of(searches, first);
    uint32_t count = 1, packets = first.lanes;
    if (Spu::direct_memory && walk_.takes_turns()) {
      Stack& stack = walk_.stack();
      while (count < BranchWalk<Spu>::kMostInTurn && stack.size() != 0) {
        const typename Stack::Entry& next = stack.top();
        if (next.rays == 0 || (next.lanes & packets) != 0) break;
        stack.pop();
        if ((next.lanes & looking_as_far_as(next.enter)) == 0) continue;
        visits[count++] = visit_of(searches, next);
        packets |= next.lanes;
      }
    }
    if (count == 1) {
      objects_.mailbox().begin_packet();
      walk_.walk(visits[0], sides);
    } else {
      walk_.walk_in_turn(visits, count, sides);
    }
    update_limits(packets, searches);
  }
  /// Of an entry for one packet.
  typename BranchWalk<Spu>::Visit visit_of(Search* searches, const typename Stack::Entry& entry) {
    const auto packet = static_cast<uint32_t>(__builtin_ctz(entry.lanes));
    Search& search = searches[packet];
    if ((known_beams_ & entry.lanes) == 0) {
      if (Spu::direct_memory && turned_)
        members_[packet].beam.set(bounds_of<S>(*search.rays, search.lanes), octant_);
      else
        beams_.get(packet, members_[packet].beam);
      known_beams_ |= entry.lanes;
    }
    return {&members_[packet], &search, search.lanes, entry.rays, entry.branch};
  }

  const OctantRays<S>& rays_of(const Search& search, uint32_t packet) {
    if ((known_rays_ & (1u << packet)) == 0) {
      objects_.scene().spu().compute(scalar_work::kRaysOfPacket);
      members_[packet].rays.set(*search.rays, octant_);
      known_rays_ |= 1u << packet;
    }
    return members_[packet].rays;
  }

  /// As BranchWalk's, with the packets' beams in place of rays. The rays themselves are asked where objects
  /// are and where beams are loose.
  bool open(const Search* searches, const BoxSides& sides, const BoxSides& ray_sides, uint32_t packets,
            Branch& branch) {
    objects_.scene().spu().compute(scalar_work::kNodeOfBoxes);
    ++objects_.counters().voxels;
    const NodeRecord& node = *objects_.scene().node(branch.child);
    alignas(16) float enter[4];
    uint32_t met = around_.meets(node.box, sides, farthest_, enter);
    if (met == 0) return false;
    if (is_single(met)) {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(met));
      if (node.leaf[i] == 0) {
        branch = {node.child[i], 0};
        return true;
      }
    }
    Stack& stack = walk_.stack();
    const uint32_t first = stack.size();
    do {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(met));
      met &= met - 1;
      objects_.scene().spu().compute(scalar_work::kChildOfNode);
      uint32_t lanes = beams_.meet(node.box, sides, i, limits_) & packets;
      const Branch child = {node.child[i], node.leaf[i]};
      const bool ask_all = (child.is_leaf() && !trusts_beams()) || is_lonely(lanes);
      if (lanes == 0) continue;
      objects_.scene().hint(child);
      lanes &= ~without_rays_in(node.box, ray_sides, i, searches, ask_all ? lanes : lanes & loose_);
      if (ask_all && !child.is_leaf())
        for_each_lane(lanes, [&](uint32_t packet) {
          stack.push(first, {child, 1u << packet, enter[i], rays_[packet]});
        });
      else if (lanes != 0)
        stack.push(first, {child, lanes, enter[i], 0});
    } while (met != 0);
    return false;
  }

  /// Beams through one point are hardly larger than their rays; but where an object has to be fetched, that
  /// takes longer than asking them.
  bool trusts_beams() const { return Spu::direct_memory && view_ != nullptr; }
  /// Where objects are small beside pixels, the packets of a bundle part early.
  static uint32_t most_alone(const FrameBlock& frame) {
    constexpr uint32_t kMost = BranchWalk<Spu>::kMostAlone;
    return kMost == 1 || frame.object_count <= frame.width * frame.height / 2 ? 1 : kMost;
  }
  bool is_lonely(uint32_t packets) const {
    if constexpr (BranchWalk<Spu>::kMostAlone == 1) return is_single(packets);
    return static_cast<uint32_t>(__builtin_popcount(packets)) <= most_alone_;
  }

  /// Those of the packets that have no ray that meets the box; the others' rays that do go to rays_.
  uint32_t without_rays_in(const float (&box)[6][4], const BoxSides& sides, uint32_t i,
                           const Search* searches, uint32_t packets) {
    uint32_t without = 0;
    for_each_lane(packets, [&](uint32_t packet) {
      const Search& search = searches[packet];
      objects_.scene().spu().compute(scalar_work::kRaysInBox);
      const uint32_t rays =
          rays_of(search, packet).meet(box, sides, i, BranchWalk<Spu>::limits(search)) & search.lanes;
      rays_[packet] = rays;
      const uint32_t missed = static_cast<uint32_t>(rays == 0);
      without |= missed << packet;
      misses_[packet] += missed;
      loose_ |= static_cast<uint32_t>(misses_[packet] >= kMissesOfLoose) << packet;
    });
    return without;
  }

  void meet(BundleLeafTests<Spu>& leaves, const Branch& leaf, uint32_t packets, Search* searches) {
    uint32_t changed = packets;
    if (Spu::direct_memory && view_ != nullptr && !is_single(packets))
      changed = leaves.add(searches, packets, leaf);
    else
      objects_.scene().for_each_object(leaf, [&](uint32_t self) {
        test_object(self, packets, searches);
        return false;
      });
    update_limits(changed, searches);
  }
  /// Before a node is opened, what lies in leaves should be known.
  bool goes_on_with(const BundleLeafTests<Spu>& leaves) {
    if (!Spu::direct_memory || !leaves.is_waiting()) return true;
    const Stack& stack = walk_.stack();
    return stack.size() != 0 && stack.top().branch.is_leaf() && leaves.has_room_for(stack.top().branch);
  }
  void test_waiting(BundleLeafTests<Spu>& leaves, Search* searches, uint32_t together) {
    update_limits(leaves.test(searches, *view_), searches);
    farthest_ = Lanes::greatest_of(together, limits_);
  }
  void test_object(uint32_t self, uint32_t packets, Search* searches) {
    if constexpr (Spu::direct_memory) {
      if (searches[__builtin_ctz(packets)].hits != nullptr)
        objects_.test_closest_of_all(searches, packets, self);
      else
        objects_.shadow_all(searches, packets, self);
      return;
    }
    for_each_lane(packets, [&](uint32_t packet) {
      Search& search = searches[packet];
      if (search.hits != nullptr) {
        objects_.test_closest(*search.rays, self, *search.hits);
      } else if (search.lanes != 0) {
        objects_.mailbox().begin_packet();
        search.lanes &= ~objects_.shadowed(*search.rays, self, search.lanes, *search.distance, *search.light);
      }
    });
  }

  void update_limits(uint32_t packets, const Search* searches) {
    for_each_lane(packets, [&](uint32_t packet) { update_limit(searches[packet], packet); });
  }
  /// A packet that no light comes to any more looks nowhere.
  void update_limit(const Search& search, uint32_t packet) {
    if (search.hits != nullptr)
      limits_[packet] = BranchWalk<Spu>::limit_of(search, search.lanes) * shortening(packet);
    else if (search.lanes == 0)
      limits_[packet] = -1.0f;
  }
  /// By which distances along a packet's rays are multiplied to get those along its beam.
  float shortening([[maybe_unused]] uint32_t packet) const {
    if constexpr (Spu::direct_memory) return view_ != nullptr ? shortening_[packet] : 1.0f;
    return 1.0f;
  }
  uint32_t looking_as_far_as(float distance) const {
    return Lanes::at_most(Lanes::splat(distance), Lanes::Type::load(limits_));
  }

  ObjectTests<Spu>& objects_;
  const HierarchyRecord& hierarchy_;
  BranchWalk<Spu> walk_;
  const uint32_t most_alone_;                ///< packets
  RayGroup<S> members_[kBundlePackets<Spu>]; ///< packets of the bundle; a packet alone is the first
  BundleBeams<S, kBundlePackets<Spu>> beams_;
  Beam<S> around_;                                     ///< all of them
  uint32_t rays_[kBundlePackets<Spu>];                 ///< of each packet that was asked last
  uint32_t misses_[kBundlePackets<Spu>];               ///< boxes that a beam met but no ray
  uint32_t loose_ = 0;                                 ///< packets
  float farthest_ = 0.0f;                              ///< no packet looks farther
  const BundleView<S>* view_ = nullptr;                ///< of theirs, if they go through one point
  uint32_t octant_ = 0;                                ///< of all rays that go together
  bool turned_ = false;                                ///< their beams go the other way
  uint32_t known_rays_ = 0, known_beams_ = 0;          ///< packets of which members_ has them
  alignas(64) float limits_[kBundlePackets<Spu>] = {}; ///< how far each packet looks along its beam
  /// Of each packet of primary rays, which go through one point.
  alignas(64) float shortening_[Spu::direct_memory ? kBundlePackets<Spu> : 1] = {};
};

} // namespace celltrace::kernel
