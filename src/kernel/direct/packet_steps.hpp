// Steps of a packet's traversal where the processor prefetches memory, line by line: leaves wait until their
// objects have arrived, and traversals of several packets are interleaved. Kernel dialect.
#pragma once

#include "kernel/accel/packet_traversal.hpp"
#include "kernel/direct/deferred_leaves.hpp"
#include "kernel/direct/leaf_tests.hpp"

namespace celltrace::kernel {

template <class Traversal, class Spu> class DirectPacketSteps {
public:
  static constexpr uint32_t kMaxInterleaved = tuning::kMaxInterleaved;
  bool interleaves() const { return interleaves_; }

  /// Returns the distance up to which nodes are too near. If surfaces lie on each other, there are many such
  /// nodes.
  static float tnear(const RayQuery& query) {
    return 0.5f * (query.hits != nullptr ? kMinHitDistance : kShadowEpsilon);
  }

protected:
  using Deferred = DeferredLeaves;

  explicit DirectPacketSteps(const FrameBlock& frame)
      : defers_leaves_(frame.object_count > tuning::kObjectsInCoreCache), interleaves_(frame.far_nodes != 0) {
  }

  [[gnu::always_inline]] bool test_leaf(const NodeRef& leaf, uint32_t group, RayQuery& query) {
    if (leaf_word::count(leaf.leaf) < tuning::kLeastTrianglesByLeaf) return false;
    if (__builtin_popcount(group) <= tuning::kMostRaysByLeaf) {
      LeafTests<Spu>(traversal().objects_).test(query, group, leaf);
      return true;
    }
    if (query.hits != nullptr) return false;
    traversal().objects_.test_occlusion_by_leaf(leaf, group, query);
    return true;
  }

  template <class Slot, class State>
  [[gnu::always_inline]] bool defer(Slot& slot, State& state, const NodeRef& leaf, RayQuery& query) {
    if (!defers_leaves_) return false;
    if (slot.deferred.is_full()) test_deferred(slot, state, query);
    traversal().objects_.scene().hint(leaf);
    slot.deferred.add(leaf, state.group);
    return true;
  }
  template <class Slot, class State> void test_deferred(Slot& slot, State& state, RayQuery& query) {
    if (slot.deferred.count() == 0) return;
    for (uint32_t i = 0; i < slot.deferred.count(); ++i)
      traversal().test_objects(slot.deferred[i].ref, slot.deferred[i].group, query);
    slot.deferred.clear();
    traversal().update_state(slot, state, query);
  }

private:
  Traversal& traversal() { return static_cast<Traversal&>(*this); }

  const bool defers_leaves_;
  const bool interleaves_;
};

} // namespace celltrace::kernel
