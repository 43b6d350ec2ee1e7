// Steps of a packet's traversal in local store: one node or leaf after the other. Kernel dialect.
#pragma once

#include "kernel/accel/packet_traversal.hpp"

namespace celltrace::kernel {

template <class Traversal, class Spu> class LocalPacketSteps {
public:
  static constexpr uint32_t kMaxInterleaved = 1;
  static constexpr bool interleaves() { return false; }
  static constexpr float tnear(const RayQuery&) { return 0.0f; }

protected:
  struct Deferred {
    static constexpr bool are_enough() { return false; }
  };

  explicit LocalPacketSteps(const FrameBlock&) {}

  static constexpr bool test_leaf(const NodeRef&, uint32_t, const RayQuery&) { return false; }
  template <class Slot, class State>
  static constexpr bool defer(const Slot&, const State&, const NodeRef&, const RayQuery&) {
    return false;
  }
  template <class Slot, class State> static void test_deferred(const Slot&, const State&, const RayQuery&) {}

  template <class Slot, class State, class Rays, class Order>
  [[gnu::always_inline]] void push_hit(Slot& slot, const State& state, const Rays& rays, const Order& order,
                                       const RayQuery& query, const NodeRecord& node, uint32_t hit,
                                       const float (&enter)[4]) {
    auto& scene = static_cast<Traversal&>(*this).objects_.scene();
    const uint32_t group = state.group;
    const auto each_tfar = Traversal::tfar(query);
    const uint32_t first = slot.stack.size();
    do {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(hit));
      hit &= hit - 1;
      scene.spu().compute(scalar_work::kBvhChild);
      // For a single ray, the frustum is the ray.
      const uint32_t lanes =
          is_single(group) ? group : rays.intersect(node.bounds, order, i, each_tfar) & group;
      if (lanes == 0) continue;
      const NodeRef child = {node.child[i], node.leaf[i]};
      scene.hint(child);
      slot.stack.push(first, {child, lanes, enter[i], 0});
    } while (hit != 0);
  }
};

} // namespace celltrace::kernel
