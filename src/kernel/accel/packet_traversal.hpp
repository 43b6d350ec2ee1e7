// Traversal of the BVH with one packet of rays, from any node on. Kernel dialect.
//
// The nearest child is traversed first. If the packet's frustum hits several children of a node, each of them
// is tested against the rays themselves, because a frustum may hit what lies between its rays; if it hits one
// child only, that test would not pay. A child that a single ray hits is traversed for that ray only, with a
// frustum of its own. An object in a leaf is tested against the whole packet.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/accel/frustum.hpp"
#include "kernel/accel/object_tests.hpp"
#include "kernel/accel/traversal_loop.hpp"

namespace celltrace::kernel {

/// A group of a packet's rays that are traversed together; their directions are in one octant.
template <class S> struct RayGroup {
  OctantRays<S> rays;
  Frustum<S> frustum;
};

/// Traverses the BVH with packets. A strategy's PacketSteps have:
///
///   kMaxInterleaved                     largest number of interleaved traversals
///   interleaves()                       true if traverse_interleaved() is faster than one after the other
///   tnear(query)                        distance up to which nodes may be left out, as hits are too near
///   test_leaf(leaf, group, query)       tests the objects of a leaf together; false: not tested
///   Deferred                            type of the deferred leaves, which wait until there `are_enough()`
///   defer(slot, state, leaf, query)     defers a leaf; false: not deferred
///   test_deferred(slot, state, query)   tests the deferred leaves
template <class Spu>
class PacketTraversal : public Strategy<Spu>::template PacketSteps<PacketTraversal<Spu>, Spu> {
  using Steps = typename Strategy<Spu>::template PacketSteps<PacketTraversal, Spu>;
  friend Steps;

public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using M = typename S::M;

  /// Relative epsilon of tfar, as a factor. Distances to hits are rounded, and a node at the distance of a
  /// hit must still be traversed: it may hold an object at the same distance that comes first in the scene.
  static constexpr float kTfarSlack = 1.00001f;
  static constexpr uint32_t kMaxSplitPackets = kBundlePackets<Spu> >= 16 ? tuning::kMaxSplitPackets : 1;
  using Stack = TraversalStack<kMaxSplitPackets>;

  /// A node to traverse with a packet. `lanes` are the packet's rays in `group`, `hit` the rays of `lanes`
  /// that hit the node.
  struct Task {
    const RayGroup<S>* group;
    RayQuery* query;
    uint32_t lanes, hit;
    NodeRef ref;
  };
  using Steps::kMaxInterleaved, Steps::tnear;

  PacketTraversal(ObjectTests<Spu>& objects, const FrameBlock& frame) : Steps(frame), objects_(objects) {}

  Stack& stack() { return slots_[0].stack; }

  /// Traverses the subtree below a task's node.
  void traverse(const Task& task, const SlabOrder& order) {
    Slot& slot = slots_[0];
    const uint32_t floor = slot.stack.size();
    PacketVisitor<false> visitor = {
        *this, slot, order, *task.group, *task.query, begin(slot, task, floor), task.lanes, floor};
    NodeRef ref = task.ref;
    traverse_nodes(visitor, ref);
    visitor.end();
  }

  /// Traverses the subtrees of several tasks, each of a different packet, interleaved: while the node that
  /// one traversal needs is fetched from memory, another one advances.
  void traverse_interleaved(const Task* tasks, uint32_t count, const SlabOrder& order) {
    Interleaved interleaved[kMaxInterleaved];
    for (uint32_t i = 0; i < count; ++i) {
      Slot& slot = slots_[i];
      if (i != 0) slot.stack.shrink(0);
      const uint32_t floor = slot.stack.size();
      const uint32_t packet = objects_.hit_filter().begin_packet();
      interleaved[i] = {tasks[i].ref, begin(slot, tasks[i], floor), floor, packet};
    }
    uint32_t active = (1u << count) - 1;
    while (active != 0)
      for (uint32_t left = active; left != 0; left &= left - 1) {
        const auto i = static_cast<uint32_t>(__builtin_ctz(left));
        Interleaved& traversal = interleaved[i];
        objects_.hit_filter().resume_packet(traversal.packet);
        // The copy of the state can stay in registers until the traversal is suspended.
        const Task& task = tasks[i];
        PacketVisitor<true> visitor = {*this,       slots_[i],       order,      *task.group,
                                       *task.query, traversal.state, task.lanes, traversal.floor};
        if (traverse_nodes(visitor, traversal.ref)) {
          traversal.state = visitor.state;
        } else {
          visitor.end();
          active &= ~(1u << i);
        }
      }
  }

  /// Returns the tfar of each ray: the distance of its closest hit so far, or of the light.
  static F tfar(const RayQuery& query) {
    return F::load(query.hits != nullptr ? query.hits->distance.lane : query.distance->lane);
  }
  /// Returns the greatest tfar of the rays in `group`, times kTfarSlack. Distances are positive.
  CELLTRACE_ONE_COPY static float tfar_of(const RayQuery& query, uint32_t group) {
    if (is_single(group)) {
      const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(group));
      return kTfarSlack *
             (query.hits != nullptr ? query.hits->distance.lane[lane] : query.distance->lane[lane]);
    }
    return kTfarSlack * interval_of<S>(S::select(M::from_bits(group), tfar(query), F(0.0f))).high;
  }

  /// Tests the objects of a leaf that the rays in `group` hit.
  void test_objects(const NodeRef& leaf, uint32_t group, RayQuery& query) {
    if (Steps::test_leaf(leaf, group, query)) return;
    objects_.scene().for_each_object(leaf, [&](uint32_t self) {
      if (query.hits != nullptr) {
        if (objects_.hit_filter().first_test(self)) objects_.test_closest(*query.rays, self, *query.hits);
        return false;
      }
      query.lanes &= ~objects_.occluded(*query.rays, self, group, *query.distance, *query.light);
      return (query.lanes & group) == 0;
    });
  }

private:
  /// State of a traversal: the rays in `group`, with their frustum, up to `tfar`. Stack entries below `floor`
  /// belong to other traversals.
  struct TraversalState {
    const Frustum<S>* frustum;
    uint32_t group, floor;
    float tfar;
  };

  /// The storage of one of several interleaved traversals.
  struct Slot {
    Stack stack;
    [[no_unique_address]] typename Steps::Deferred deferred;
    Frustum<S> single; ///< frustum of a ray that has been split off
  };

  /// An interleaved traversal that is suspended.
  struct Interleaved {
    NodeRef ref; ///< the next node to traverse
    TraversalState state;
    uint32_t floor, packet; ///< `packet` identifies the packet for the hit filter
  };

  /// A traversal for traverse_nodes(). An interleaved one is suspended when it needs a node that has just
  /// been prefetched.
  template <bool kInterleaved> struct PacketVisitor {
    PacketTraversal& traversal;
    Slot& slot;
    const SlabOrder& order;
    const RayGroup<S>& group;
    RayQuery& query;
    TraversalState state;
    const uint32_t lanes, floor;
    bool hinted = false; ///< true if the last step was to expand a node and one of its children is next

    [[gnu::always_inline]] bool expand(NodeRef& ref) {
      [[maybe_unused]] const uint32_t size = slot.stack.size();
      const bool descends = traversal.expand(slot, state, group.rays, order, query, ref);
      if constexpr (kInterleaved) {
        if (descends) traversal.objects_.scene().hint(ref);
        hinted = descends || slot.stack.size() > size;
      }
      if (!descends && slot.deferred.are_enough()) traversal.Steps::test_deferred(slot, state, query);
      return descends;
    }
    [[gnu::always_inline]] void test(const NodeRef& leaf) {
      hinted = false;
      traversal.intersect_leaf(slot, state, leaf, query);
    }
    [[gnu::always_inline]] bool next(NodeRef& ref) {
      return traversal.pop_next(slot, state, {&group.frustum, lanes, floor, 0.0f}, query, ref);
    }
    bool pauses() const { return kInterleaved && hinted; }
    [[gnu::always_inline]] void end() {
      traversal.Steps::test_deferred(slot, state, query);
      slot.stack.shrink(floor);
    }
  };

  TraversalState begin(Slot& slot, const Task& task, uint32_t floor) {
    TraversalState state = {&task.group->frustum, task.lanes, floor, tfar_of(*task.query, task.lanes)};
    if (is_single(task.hit) && !is_single(task.lanes)) split_off(slot, state, task.hit, *task.query);
    return state;
  }

  /// Pops the next node or leaf; returns false if there is none. If only one ray of the group `whole` hits a
  /// node, the node is traversed for this ray with its own, tighter frustum. The group continues once the
  /// stack is back at the group's entries.
  bool pop_next(Slot& slot, TraversalState& state, const TraversalState& whole, const RayQuery& query,
                NodeRef& ref) {
    const uint32_t lanes = whole.group;
    for (;;) {
      if (slot.stack.size() == state.floor) {
        if (state.group == lanes || (query.lanes & lanes) == 0) return false;
        state = whole;
        state.tfar = tfar_of(query, lanes);
        continue;
      }
      const typename Stack::Entry& next = slot.stack.pop();
      if (next.enter > state.tfar || (next.lanes & query.lanes) == 0) continue;
      if (!next.ref.is_leaf() && is_single(next.lanes) && state.group == lanes && !is_single(lanes)) {
        if (next.enter > tfar_of(query, next.lanes)) continue;
        split_off(slot, state, next.lanes, query);
      }
      ref = next.ref;
      return true;
    }
  }

  /// Continues with one ray of the group.
  void split_off(Slot& slot, TraversalState& state, uint32_t ray, const RayQuery& query) {
    objects_.scene().spu().compute(scalar_work::kRayAlone);
    set_single(slot, state, ray, query);
  }
  CELLTRACE_ONE_COPY void set_single(Slot& slot, TraversalState& state, uint32_t ray, const RayQuery& query) {
    const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(ray));
    slot.single.set(bounds_of_ray(*query.rays, lane), octant_of(*query.rays, lane));
    state = {&slot.single, ray, slot.stack.size(), tfar_of(query, ray)};
  }

  /// Tests the objects of a leaf, or defers the leaf with a few others until after a node is expanded.
  /// Meanwhile the objects are prefetched; and while they are tested, the node's children are prefetched.
  void intersect_leaf(Slot& slot, TraversalState& state, const NodeRef& leaf, RayQuery& query) {
    if (Steps::defer(slot, state, leaf, query)) return;
    test_objects(leaf, state.group, query);
    update_state(slot, state, query);
  }
  /// Shortens tfar after hits, or ends the traversal of a group whose rays are all occluded.
  void update_state(Slot& slot, TraversalState& state, const RayQuery& query) {
    if (query.hits != nullptr)
      state.tfar = tfar_of(query, state.group);
    else if ((query.lanes & state.group) == 0)
      slot.stack.shrink(state.floor);
  }

  /// Intersects the children of node `ref` with the group. If the group's frustum hits one child, stores the
  /// child in `ref` and returns true. If it hits several, pushes the children that a ray hits.
  bool expand(Slot& slot, const TraversalState& state, const OctantRays<S>& rays, const SlabOrder& order,
              const RayQuery& query, NodeRef& ref) {
    objects_.scene().spu().compute(scalar_work::kBvhNode);
    ++objects_.counters().visits;
    const NodeRecord& node = *objects_.scene().node(ref.child);
    alignas(16) float enter[4];
    uint32_t hit = state.frustum->intersect(node.bounds, order, state.tfar, enter, tnear(query));
    if (hit == 0) return false;
    if (is_single(hit)) {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(hit));
      ref = {node.child[i], node.leaf[i]};
      return true;
    }
    const uint32_t group = state.group;
    const F each_tfar = tfar(query);
    const uint32_t first = slot.stack.size();
    do {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(hit));
      hit &= hit - 1;
      objects_.scene().spu().compute(scalar_work::kBvhChild);
      // The frustum of a single ray is as tight as the ray.
      const uint32_t lanes =
          is_single(group) ? group : rays.intersect(node.bounds, order, i, each_tfar, tnear(query)) & group;
      if (lanes == 0) continue;
      const NodeRef child = {node.child[i], node.leaf[i]};
      objects_.scene().hint(child);
      slot.stack.push(first, {child, lanes, enter[i], 0});
    } while (hit != 0);
    return false;
  }

  ObjectTests<Spu>& objects_;
  Slot slots_[kMaxInterleaved]; ///< traverse() uses the first
};

} // namespace celltrace::kernel
