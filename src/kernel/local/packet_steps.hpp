// Steps of a packet's traversal in local store: one node or leaf after another. Kernel dialect.
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
};

} // namespace celltrace::kernel
