// Rays of many ray trees that hit nothing, in full packets. Kernel dialect, where memory is direct.
//
// Of the rays that curved mirrors and glass send on often few of a packet go to the sky, whose patterns take
// as long for one as for all. Such rays of all trees of a bundle wait here until they fill a packet.
#pragma once

#include "kernel/shading/ray_stack.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel {

/// Directions of rays of different trees, each of which brings light to its pixel's own.
struct SkyRays {
  VectorLanes direction;
  VectorLanes throughput; ///< what the sky's colour is multiplied by on its way into the pixel
  WordLanes pixels;       ///< of the bundle, by lane
};

template <class Spu> class SkyQueue {
public:
  explicit SkyQueue(Spu& spu) : packet_(*spu.template allocate<SkyRays>()) {}

  /// Whether so many lanes of a packet had better wait.
  static bool takes(uint32_t lanes) { return __builtin_popcount(lanes) < tuning::kLeastRaysByThemselves; }
  /// Adds some rays of a node. Calls `see(packet)` once a packet is full.
  template <class See>
  void add(const RayNode& node, const WordLanes& pixels, uint32_t lanes, const See& see) {
    for_each_lane(lanes, [&](uint32_t lane) {
      const uint32_t to = count_++;
      copy_lane(node.rays.direction, lane, packet_.direction, to);
      copy_lane(node.throughput, lane, packet_.throughput, to);
      copy_lane(pixels, lane, packet_.pixels, to);
      if (count_ < kSimdLanes) return;
      count_ = 0;
      see(packet_);
    });
  }
  /// Calls `see(packet, lanes)` for what still waits.
  template <class See> void finish(const See& see) {
    const uint32_t left = count_;
    count_ = 0;
    if (left != 0) see(packet_, (1u << left) - 1);
  }
  /// Forgets all rays.
  void clear() { count_ = 0; }

private:
  SkyRays& packet_;
  uint32_t count_ = 0; ///< of rays that wait
};

} // namespace celltrace::kernel
