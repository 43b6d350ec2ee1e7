// One packet of rays through the BVH, from any node on. Kernel dialect.
//
// The rays of a packet are traversed together, nearest children first. A node's child that their frustum
// intersects is tested against the rays themselves before it is expanded; a child that a single ray hits is
// traversed for that ray alone, with a frustum of its own. An object in a leaf is tested against the whole
// packet.
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

  /// Relative epsilon of tfar: the distance to a hit is rounded, and a node at just that distance may hold
  /// the object of the same distance that comes first in the scene.
  static constexpr float kTfarSlack = 1.00001f;
  /// Up to this many objects, a core's own caches hold them and their nodes, and leaves are tested at once.
  /// With more, leaves are deferred while their objects are fetched.
  static constexpr uint32_t kObjectsInCoreCache = 20000;
  /// A node that this many packets of a bundle hit, or fewer, is traversed by each of them alone.
  static constexpr uint32_t kMostAlone = kBundlePackets<Spu> >= 16 ? 4 : 1; // measured
  using Stack = TraversalStack<kMostAlone>;

  /// A node to traverse for a packet. `lanes` are the rays that `group` consists of, `hit` those of them that
  /// hit the node.
  struct Task {
    const RayGroup<S>* group;
    RayQuery* query;
    uint32_t lanes, hit;
    NodeRef ref;
  };
  static constexpr uint32_t kMostInterleaved = Spu::direct_memory ? 4 : 1; // measured

  PacketTraversal(ObjectTests<Spu>& objects, const FrameBlock& frame)
      : objects_(objects), defers_leaves_(Spu::direct_memory && frame.object_count > kObjectsInCoreCache),
        interleaves_(Spu::direct_memory && frame.far_nodes != 0) {}

  Stack& stack() { return slots_[0].stack; }
  /// Whether traverse_interleaved() is quicker than one traversal after the other.
  bool interleaves() const { return interleaves_; }

  /// Tests the rays of a task against the objects below its node.
  void traverse(const Task& task, const SlabOrder& sides) {
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
        if (expand(slot, state, group.rays, sides, query, ref)) continue;
        if (slot.deferred_count >= kEnoughDeferred) test_deferred(slot, state, query);
      }
      if (!pop_next(slot, state, {&group.frustum, lanes, floor, 0.0f}, query, ref)) break;
    }
    test_deferred(slot, state, query);
    slot.stack.shrink(floor);
  }

  /// The same for several tasks, each of a packet of its own. They take turns: while the node that one of
  /// them needs is fetched from memory, another advances.
  void traverse_interleaved(const Task* tasks, uint32_t count, const SlabOrder& sides) {
    Interleaved interleaved[kMostInterleaved];
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
        if (!advance(slots_[i], interleaved[i], sides)) active &= ~(1u << i);
      }
  }

  /// tfar of each ray: the distance of the closest hit so far, or of the light.
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
  /// The rays in `group` are being traversed, up to `tfar`. Entries of the stack below `floor` are not theirs.
  struct TraversalState {
    const Frustum<S>* frustum;
    uint32_t group, floor;
    float tfar;
  };

  /// A leaf that the rays in `group` have hit.
  struct DeferredLeaf {
    NodeRef leaf;
    uint32_t group;
  };
  static constexpr uint32_t kMostDeferred = Spu::direct_memory ? 8 : 1;
  static constexpr uint32_t kEnoughDeferred = kMostDeferred / 2; // measured

  /// What each of several interleaved traversals has for itself.
  struct Slot {
    Stack stack;
    DeferredLeaf deferred[kMostDeferred];
    uint32_t deferred_count = 0;
    Frustum<S> single; ///< of a ray that is traversed alone
  };

  /// A traversal that has not ended.
  struct Interleaved {
    Task task; ///< `ref`: the next node
    TraversalState state;
    uint32_t floor, packet; ///< `packet`: for the hit filter
  };

  TraversalState begin(Slot& slot, const Task& task, uint32_t floor) {
    TraversalState state = {&task.group->frustum, task.lanes, floor, tfar_of(*task.query, task.lanes)};
    if (is_single(task.hit) && !is_single(task.lanes)) split_off(slot, state, task.hit, *task.query);
    return state;
  }

  /// As traverse(), up to the first node that has been prefetched only just now, or to the end, which returns
  /// false. It is a loop of its own because the state of traverse() would not stay in registers if that could
  /// be left and resumed.
  bool advance(Slot& slot, Interleaved& turn, const SlabOrder& sides) {
    Task& task = turn.task;
    TraversalState& state = turn.state;
    RayQuery& query = *task.query;
    for (;;) {
      const uint32_t size = slot.stack.size();
      if (task.ref.is_leaf()) {
        intersect_leaf(slot, state, task.ref, query);
      } else {
        if (expand(slot, state, task.group->rays, sides, query, task.ref)) {
          objects_.scene().hint(task.ref);
          return true;
        }
        if (slot.deferred_count >= kEnoughDeferred) test_deferred(slot, state, query);
      }
      const bool pushed = slot.stack.size() > size;
      if (!pop_next(slot, state, {&task.group->frustum, task.lanes, turn.floor, 0.0f}, query,
                     task.ref))
        break;
      if (pushed) return true;
    }
    test_deferred(slot, state, query);
    slot.stack.shrink(turn.floor);
    return false;
  }

  /// Pops the next node; false if there is none. A node that only one of the rays of `whole` hits is traversed
  /// for that ray alone, whose own frustum misses more of the children; the other rays continue when the stack
  /// is back at their entries.
  bool pop_next(Slot& slot, TraversalState& state, const TraversalState& whole, const RayQuery& query, NodeRef& ref) {
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
  [[gnu::always_inline]] void set_single(Slot& slot, TraversalState& state, uint32_t ray, const RayQuery& query) {
    const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(ray));
    slot.single.set(bounds_of_ray(*query.rays, lane), octant_of(*query.rays, lane));
    state = {&slot.single, ray, slot.stack.size(), tfar_of(query, ray)};
  }
  /// One copy: local store is short.
  [[gnu::noinline]] void set_single_out_of_line(Slot& slot, TraversalState& state, uint32_t ray,
                                             const RayQuery& query) {
    set_single(slot, state, ray, query);
  }

  /// Tests the objects of a leaf at once; or defers the leaf, with a few more, until the next node is
  /// expanded. Its objects are prefetched meanwhile, and that node's children while the objects are tested.
  void intersect_leaf(Slot& slot, TraversalState& state, const NodeRef& leaf, RayQuery& query) {
    if (!Spu::direct_memory || !defers_leaves_) {
      test_objects(leaf, state.group, query);
      take_results(slot, state, query);
    } else {
      if (slot.deferred_count == kMostDeferred) test_deferred(slot, state, query);
      objects_.scene().hint(leaf);
      slot.deferred[slot.deferred_count++] = {leaf, state.group};
    }
  }
  void test_deferred(Slot& slot, TraversalState& state, RayQuery& query) {
    if (!Spu::direct_memory || slot.deferred_count == 0) return;
    for (uint32_t i = 0; i < slot.deferred_count; ++i)
      test_objects(slot.deferred[i].leaf, slot.deferred[i].group, query);
    slot.deferred_count = 0;
    take_results(slot, state, query);
  }
  void take_results(Slot& slot, TraversalState& state, const RayQuery& query) {
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

  /// Intersects the node at `ref` with the group. If one child is hit, `ref` becomes that child and the result
  /// is true; if several are, they are pushed.
  bool expand(Slot& slot, const TraversalState& state, const OctantRays<S>& rays, const SlabOrder& sides,
            const RayQuery& query, NodeRef& ref) {
    objects_.scene().spu().compute(scalar_work::kBvhNode);
    ++objects_.counters().visits;
    const NodeRecord& node = *objects_.scene().node(ref.child);
    alignas(16) float enter[4];
    uint32_t hit = state.frustum->intersect(node.bounds, sides, state.tfar, enter);
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
      // A frustum may hit what lies between its rays.
      const uint32_t lanes = is_single(group) ? group : rays.intersect(node.bounds, sides, i, each_tfar) & group;
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
  Slot slots_[kMostInterleaved]; ///< traverse() uses the first
};

} // namespace celltrace::kernel
