// The ray tree without recursion: a stack of ray packets that are still to be traced. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"
#include "kernel/strategy.hpp"
#include "records/frame.hpp"

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

/// A stack of nodes, of which at most `kResident` are in local store. Depth-first order makes a tree of level
/// n need n + 1 nodes at most.
///
///   RayStack(spu, memory, nodes, resident, next)   there is room for `nodes` at `memory`; `resident`: nodes
///   in
///                                       local store, where it has no room for kResident; `next`: a place for
///                                       next()
///   empty(), clear()
///   next()                              where the node is made that is pushed next
///   push()                              pushes next(); false: the stack is full
///   next_like(pushed)                   makes next() the same as the node that has just been pushed
///   pop(node)
///   spilled()                           nodes that did not fit in local store since reset_counters()
template <class Spu, uint32_t kResident = kResidentNodes>
using RayStack = typename Strategy<Spu>::template RayStack<Spu, kResident>;

} // namespace celltrace::kernel
