// Traverses the BVH with one packet of rays, from any node on. Kernel dialect.
//
// The nearest child is traversed first. If the packet's frustum hits several children of a node, each of them
// is tested against the rays themselves, because a frustum may hit what lies between its rays; if it hits one
// child only, that test would not pay. A child that a single ray hits is traversed for that ray only, with a
// frustum of its own. An object in a leaf is tested against the whole packet.
#pragma once

#include "kernel/accel/frustum.hpp"
#include "kernel/accel/traversal_stack.hpp"
#include "kernel/direct/leaf_tests.hpp"

namespace celltrace::kernel {

/// Rays of a packet that are traversed together; their directions are of one octant.
template <class S> struct RayGroup {
  OctantRays<S> rays;
  Frustum<S> frustum;
};

template <class Spu> class PacketTraversal {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using M = typename S::M;

  /// Relative epsilon of tfar, as a factor. Distances to hits are rounded; and a node at the distance of a
  /// hit must still be traversed, because it may hold an object at the same distance that precedes in the
  /// scene.
  static constexpr float kTfarSlack = 1.00001f;
  /// Up to this many objects, the caches of one core hold them with their nodes, and leaves are tested at
  /// once. With more objects, leaves are deferred while their objects are prefetched. Smaller: leaves are
  /// deferred although nothing has to be waited for; larger: tests wait for memory. Measured.
  static constexpr uint32_t kObjectsInCoreCache = 20000;
  /// A node that this many packets of a bundle hit, or fewer, may be traversed by each of them separately.
  /// Larger: packets share fewer nodes; smaller: more nodes are tested for packets that do not hit them.
  /// Measured.
  static constexpr uint32_t kMaxSplitPackets = kBundlePackets<Spu> >= 16 ? 4 : 1;
  using Stack = TraversalStack<kMaxSplitPackets>;

  /// A node to traverse with a packet. `lanes` are the rays of the packet that `group` consists of, `hit`
  /// those of them that hit the node.
  struct Task {
    const RayGroup<S>* group;
    RayQuery* query;
    uint32_t lanes, hit;
    NodeRef ref;
  };
  /// Traversals that are interleaved. Larger: more time to fetch a node; smaller: less state to keep in
  /// cache. Measured.
  static constexpr uint32_t kMaxInterleaved = Spu::direct_memory ? 4 : 1;

  PacketTraversal(ObjectTests<Spu>& objects, const FrameBlock& frame)
      : objects_(objects), defers_leaves_(Spu::direct_memory && frame.object_count > kObjectsInCoreCache),
        interleaves_(Spu::direct_memory && frame.far_nodes != 0) {}

  Stack& stack() { return slots_[0].stack; }
  /// Whether traverse_interleaved() is faster than one traversal after the other.
  bool interleaves() const { return interleaves_; }

  /// Traverses the subtree below a task's node.
  void traverse(const Task& task, const SlabOrder& order) {
    const RayGroup<S>& group = *task.group;
    RayQuery& query = *task.query;
    const uint32_t lanes = task.lanes;
    NodeRef ref = task.ref;
    Slot& slot = slots_[0];
    const uint32_t floor = slot.stack.size();
    TraversalState state = begin(slot, task, floor);
    for (;;) {
      if (ref.is_leaf()) {
        intersect_leaf(slot, state, ref, query);
      } else {
        if (expand(slot, state, group.rays, order, query, ref)) continue;
        if (slot.deferred_count >= kEnoughDeferred) test_deferred(slot, state, query);
      }
      if (!pop_next(slot, state, {&group.frustum, lanes, floor, 0.0f}, query, ref)) break;
    }
    test_deferred(slot, state, query);
    slot.stack.shrink(floor);
  }

  /// The same for several tasks, each of a different packet, interleaved: while the node that one traversal
  /// needs is fetched from memory, another one advances.
  void traverse_interleaved(const Task* tasks, uint32_t count, const SlabOrder& order) {
    Interleaved interleaved[kMaxInterleaved];
    for (uint32_t i = 0; i < count; ++i) {
      Slot& slot = slots_[i];
      if (i != 0) slot.stack.shrink(0);
      const uint32_t floor = slot.stack.size();
      const uint32_t packet = objects_.hit_filter().begin_packet();
      interleaved[i] = {tasks[i], begin(slot, tasks[i], floor), floor, packet};
    }
    uint32_t active = (1u << count) - 1;
    while (active != 0)
      for (uint32_t left = active; left != 0; left &= left - 1) {
        const auto i = static_cast<uint32_t>(__builtin_ctz(left));
        objects_.hit_filter().resume_packet(interleaved[i].packet);
        if (!advance(slots_[i], interleaved[i], order)) active &= ~(1u << i);
      }
  }

  /// The tfar of each ray: the distance of its closest hit so far, or of the light.
  static F tfar(const RayQuery& query) {
    return F::load(query.hits != nullptr ? query.hits->distance.lane : query.distance->lane);
  }
  /// The greatest tfar of the rays in `group`, with kTfarSlack. Distances are positive.
  static float tfar_of(const RayQuery& query, uint32_t group) {
    if (is_single(group)) {
      const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(group));
      return kTfarSlack *
             (query.hits != nullptr ? query.hits->distance.lane[lane] : query.distance->lane[lane]);
    }
    return kTfarSlack * interval_of<S>(S::select(M::from_bits(group), tfar(query), F(0.0f))).high;
  }

private:
  /// What is being traversed: the rays in `group`, with their frustum, up to `tfar`. Stack entries below
  /// `floor` belong to others.
  struct TraversalState {
    const Frustum<S>* frustum;
    uint32_t group, floor;
    float tfar;
  };

  /// A leaf that the rays in `group` hit, whose objects have not been tested yet.
  struct DeferredLeaf {
    NodeRef leaf;
    uint32_t group;
  };
  static constexpr uint32_t kMaxDeferred = Spu::direct_memory ? 8 : 1;
  /// With this many deferred leaves, their objects are tested after the next node is expanded. Larger: more
  /// time to fetch them; smaller: hits shorten tfar sooner. Measured.
  static constexpr uint32_t kEnoughDeferred = kMaxDeferred / 2;

  /// The storage of one of several interleaved traversals.
  struct Slot {
    Stack stack;
    DeferredLeaf deferred[kMaxDeferred];
    uint32_t deferred_count = 0;
    Frustum<S> single; ///< of the ray that has been split off
  };

  /// An interleaved traversal that has not ended.
  struct Interleaved {
    Task task; ///< `ref`: the next node to traverse
    TraversalState state;
    uint32_t floor, packet; ///< `packet` identifies it for the hit filter
  };

  TraversalState begin(Slot& slot, const Task& task, uint32_t floor) {
    TraversalState state = {&task.group->frustum, task.lanes, floor, tfar_of(*task.query, task.lanes)};
    if (is_single(task.hit) && !is_single(task.lanes)) split_off(slot, state, task.hit, *task.query);
    return state;
  }

  /// Advances a traversal until it needs a node that was prefetched only just now. Returns false at its end.
  /// This repeats the loop of traverse(), whose state would not stay in registers if it could be suspended.
  bool advance(Slot& slot, Interleaved& traversal, const SlabOrder& order) {
    Task& task = traversal.task;
    TraversalState& state = traversal.state;
    RayQuery& query = *task.query;
    for (;;) {
      const uint32_t size = slot.stack.size();
      if (task.ref.is_leaf()) {
        intersect_leaf(slot, state, task.ref, query);
      } else {
        if (expand(slot, state, task.group->rays, order, query, task.ref)) {
          objects_.scene().hint(task.ref);
          return true;
        }
        if (slot.deferred_count >= kEnoughDeferred) test_deferred(slot, state, query);
      }
      const bool pushed = slot.stack.size() > size;
      if (!pop_next(slot, state, {&task.group->frustum, task.lanes, traversal.floor, 0.0f}, query, task.ref))
        break;
      if (pushed) return true;
    }
    test_deferred(slot, state, query);
    slot.stack.shrink(traversal.floor);
    return false;
  }

  /// Pops the next node or leaf; false if there is none. A node that only one ray of the group `whole` hits
  /// is traversed for that ray only: its own frustum is tighter and hits fewer children. The group continues
  /// once the stack is back at its entries.
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
    if constexpr (Spu::direct_memory)
      set_single(slot, state, ray, query);
    else
      set_single_out_of_line(slot, state, ray, query);
  }
  [[gnu::always_inline]] void set_single(Slot& slot, TraversalState& state, uint32_t ray,
                                         const RayQuery& query) {
    const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(ray));
    slot.single.set(bounds_of_ray(*query.rays, lane), octant_of(*query.rays, lane));
    state = {&slot.single, ray, slot.stack.size(), tfar_of(query, ray)};
  }
  /// Not inlined on an SPE: one copy of the code saves local store.
  [[gnu::noinline]] void set_single_out_of_line(Slot& slot, TraversalState& state, uint32_t ray,
                                                const RayQuery& query) {
    set_single(slot, state, ray, query);
  }

  /// Tests the objects of a leaf, or defers it with a few others until after a node is expanded. Meanwhile
  /// its objects are prefetched; and while they are tested, the children of that node are.
  void intersect_leaf(Slot& slot, TraversalState& state, const NodeRef& leaf, RayQuery& query) {
    if (!Spu::direct_memory || !defers_leaves_) {
      test_objects(leaf, state.group, query);
      update_state(slot, state, query);
    } else {
      if (slot.deferred_count == kMaxDeferred) test_deferred(slot, state, query);
      objects_.scene().hint(leaf);
      slot.deferred[slot.deferred_count++] = {leaf, state.group};
    }
  }
  void test_deferred(Slot& slot, TraversalState& state, RayQuery& query) {
    if (!Spu::direct_memory || slot.deferred_count == 0) return;
    for (uint32_t i = 0; i < slot.deferred_count; ++i)
      test_objects(slot.deferred[i].leaf, slot.deferred[i].group, query);
    slot.deferred_count = 0;
    update_state(slot, state, query);
  }
  /// Shortens tfar after hits, or ends the traversal of a group that is wholly occluded.
  void update_state(Slot& slot, TraversalState& state, const RayQuery& query) {
    if (query.hits != nullptr)
      state.tfar = tfar_of(query, state.group);
    else if ((query.lanes & state.group) == 0)
      slot.stack.shrink(state.floor);
  }

  void test_objects(const NodeRef& leaf, uint32_t group, RayQuery& query) {
    if constexpr (Spu::direct_memory) {
      using Tests = LeafTests<Spu>;
      if (leaf_word::count(leaf.leaf) >= Tests::kLeastTriangles &&
          __builtin_popcount(group) <= Tests::kMostRays)
        return Tests(objects_).test(query, group, leaf);
    }
    objects_.scene().for_each_object(leaf, [&](uint32_t self) {
      if (query.hits != nullptr) {
        if (objects_.hit_filter().first_test(self)) objects_.test_closest(*query.rays, self, *query.hits);
        return false;
      }
      query.lanes &= ~objects_.occluded(*query.rays, self, group, *query.distance, *query.light);
      return (query.lanes & group) == 0;
    });
  }

  /// Intersects the children of node `ref` with the group. If its frustum hits one child, `ref` becomes that
  /// child and the result is true. If it hits several, those that are hit by a ray are pushed.
  bool expand(Slot& slot, const TraversalState& state, const OctantRays<S>& rays, const SlabOrder& order,
              const RayQuery& query, NodeRef& ref) {
    objects_.scene().spu().compute(scalar_work::kBvhNode);
    ++objects_.counters().visits;
    const NodeRecord& node = *objects_.scene().node(ref.child);
    alignas(16) float enter[4];
    uint32_t hit = state.frustum->intersect(node.bounds, order, state.tfar, enter);
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
      // For a single ray, the frustum is the ray.
      const uint32_t lanes =
          is_single(group) ? group : rays.intersect(node.bounds, order, i, each_tfar) & group;
      if (lanes == 0) continue;
      const NodeRef child = {node.child[i], node.leaf[i]};
      objects_.scene().hint(child);
      slot.stack.push(first, {child, lanes, enter[i], 0});
    } while (hit != 0);
    return false;
  }

  ObjectTests<Spu>& objects_;
  const bool defers_leaves_;
  const bool interleaves_;
  Slot slots_[kMaxInterleaved]; ///< traverse() uses the first
};

} // namespace celltrace::kernel
