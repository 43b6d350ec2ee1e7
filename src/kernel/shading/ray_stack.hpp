// The ray tree without recursion: a stack of ray packets that wait to be traced. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"
#include "kernel/strategy.hpp"
#include "records/frame.hpp"

namespace celltrace::kernel {

/// The interiors that the rays of a packet are inside of: in each lane `interiors[d]` are their offsets,
/// outermost first, for d below `interior_depth`.
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

/// A node of the ray tree: a packet of rays with their contributions and states.
///
/// Light is added up in accumulators; number 0 is the pixel's. A reflection whose light is raised to a power
/// (POV-Ray's reflection exponent) gets an accumulator of its own, from which a node below it on the stack
/// gathers the light.
struct alignas(128) RayNode : RayInteriors {
  RayPacket rays;
  VectorLanes throughput; ///< factor of the ray's colour in the pixel
  FloatLanes weight;      ///< POV-Ray's weight of the ray, which adaptive depth control compares
  WordLanes level;        ///< trace level, 0 for primary rays
  /// In a node that gathers: the exponent. In other nodes, with light_feature::alpha: transparency up to
  /// the camera.
  FloatLanes power;
  uint32_t lanes;     ///< bit l: lane l has a ray
  uint32_t reflected; ///< lanes of rays that came by a mirror
  uint32_t target;    ///< number of the accumulator that receives the rays' light
  uint32_t gathers; ///< 0: rays to trace; otherwise the number of an accumulator, which is complete when this
                    ///< node is popped, and whose light, raised to `power`, goes to `target`

  /// Resets the node to no rays.
  void begin() { lanes = reflected = target = gathers = 0; }
};

constexpr uint32_t kRayNodeBytes = sizeof(RayNode);
static_assert(kRayNodeBytes % 128 == 0 && kRayNodeBytes <= kMaxDmaBytes, "spilled by one DMA command");

/// Nodes of a stack that stay in local store, unless its owner has several stacks.
constexpr uint32_t kResidentNodes = 3;

/// A stack of nodes, of which at most `kResident` are in local store. Depth-first order makes a tree of level
/// n need n + 1 nodes at most.
///
///   RayStack(spu, memory, nodes, resident, next)   `memory` has room for `nodes`; `resident`: nodes in local
///                                       store if it is short; `next`: memory for next()
///   empty(), clear()
///   next()                              returns the node that is pushed next
///   push()                              pushes next(); false if the stack is full
///   next_like(pushed)                   makes next() a copy of the node that has just been pushed
///   pop(node)
///   spilled()                           returns the nodes spilled since reset_counters()
template <class Spu, uint32_t kResident = kResidentNodes>
using RayStack = typename Strategy<Spu>::template RayStack<Spu, kResident>;

} // namespace celltrace::kernel
