// The ray tree without recursion: a stack of ray packets that are still to be traced. Kernel dialect.
#pragma once

#include "kernel/direct/door.hpp"
#include "kernel/packet.hpp"
#include "kernel/scalar_work.hpp"

namespace celltrace::kernel {

/// The interiors that the rays of a packet are inside of: `interiors[d]` are, per lane, their offsets,
/// outermost first, `interior_depth` of them.
struct RayInteriors {
  WordLanes interior_depth;
  WordLanes interiors[kMaxInteriorDepth];
};
[[gnu::always_inline]] inline void copy_lane(const RayInteriors& from, uint32_t lane, RayInteriors& to,
                                             uint32_t to_lane) {
  copy_lane(from.interior_depth, lane, to.interior_depth, to_lane);
  for (uint32_t i = 0; i < from.interior_depth.lane[lane]; ++i)
    copy_lane(from.interiors[i], lane, to.interiors[i], to_lane);
}

/// A packet of rays with what each contributes and where it stands.
///
/// Light is added up in accumulators; number 0 is the pixel's. A reflection whose light is raised to a power
/// (POV-Ray's reflection exponent) gets one of its own, and a node below it on the stack that gathers it.
struct alignas(128) RayNode : RayInteriors {
  RayPacket rays;
  VectorLanes throughput; ///< what the ray's colour is multiplied by on its way into the pixel
  FloatLanes weight;      ///< POV-Ray's weight of the ray, which adaptive depth control compares
  WordLanes level;        ///< trace level, 0 for primary rays
  /// Of a node that gathers; of others, with light_way::alpha, the share of what is behind the scene that
  /// would come through so far.
  FloatLanes power;
  uint32_t lanes;     ///< bit l: lane l is a ray
  uint32_t reflected; ///< of them, those that came by a mirror
  uint32_t target;    ///< number of the accumulator that the rays' light goes to
  uint32_t gathers;   ///< 0: rays to trace. Otherwise the number of an accumulator whose light, raised to
                      ///< `power`, is complete when this node comes up, and goes to `target`

  /// Without rays so far.
  void begin() { lanes = reflected = target = gathers = 0; }
};

constexpr uint32_t kRayNodeBytes = sizeof(RayNode);
static_assert(kRayNodeBytes % 128 == 0 && kRayNodeBytes <= kMaxDmaBytes, "spilled by one DMA command");

/// Nodes of a stack that stay in local store, unless its owner has many stacks.
constexpr uint32_t kResidentNodes = 3;

/// A stack whose first nodes, at most `kResident`, are in local store; deeper ones are spilled to main
/// memory, at most `spill_nodes` of them. Depth-first order makes a tree of level n need n + 1 nodes at most.
/// Where memory is direct, it is another one (direct/node_stack.hpp).
template <class Spu, uint32_t kResident = kResidentNodes, bool kInPlace = kReadsInPlace<Spu>> class RayStack {
public:
  /// `resident`: how many, where local store has no room for kResident nodes. `next`: the place for the node
  /// that is pushed next.
  RayStack(Spu& spu, ea_t spill, uint32_t spill_nodes, uint32_t resident, RayNode& next)
      : spu_(spu), resident_nodes_(resident),
        resident_(resident != 0 ? spu.template allocate<RayNode>(resident) : nullptr), spill_(spill),
        capacity_(resident_nodes_ + spill_nodes), next_(next) {}

  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }

  /// Where the node is made that is pushed next.
  RayNode& next() { return next_; }

  /// Pushes next(), which stays as it is. False if the stack is full.
  bool push() {
    if (size_ == capacity_) return false;
    if (size_ < resident_nodes_) {
      spu_.compute(scalar_work::kNodeCopy);
      resident_[size_] = next_;
    } else {
      spu_.put(&next_, place(size_), kRayNodeBytes, kTag);
      spu_.wait_all(1u << kTag);
      ++spilled_;
    }
    ++size_;
    return true;
  }

  /// `node` lies in local store.
  void pop(RayNode& node) {
    --size_;
    if (size_ < resident_nodes_) {
      spu_.compute(scalar_work::kNodeCopy);
      node = resident_[size_];
      return;
    }
    spu_.get(&node, place(size_), kRayNodeBytes, kTag);
    spu_.wait_all(1u << kTag);
  }

  void reset_counters() { spilled_ = 0; }
  /// Nodes that went to main memory since the counters were reset.
  uint32_t spilled() const { return spilled_; }

private:
  static constexpr uint32_t kTag = 6;

  ea_t place(uint32_t index) const { return spill_ + (index - resident_nodes_) * kRayNodeBytes; }

  Spu& spu_;
  uint32_t resident_nodes_;
  RayNode* resident_;
  ea_t spill_;
  uint32_t capacity_;
  RayNode& next_;
  uint32_t size_ = 0;
  uint32_t spilled_ = 0;
};

} // namespace celltrace::kernel

#include "kernel/direct/node_stack.hpp"
