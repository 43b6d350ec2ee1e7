// Hits of many ray trees from which no rays go on, in full packets. Kernel dialect, where memory is direct.
//
// Often a few rays of a packet of secondary rays end at what they hit, and the others only go on from a
// mirror: all lanes would wait while the few are lit. Such hits of all trees of a bundle wait here until they
// fill a packet.
#pragma once

#include "kernel/direct/ray_pool.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel {

/// Rays of different trees, and what they have hit.
struct QueuedHits {
  PooledPacket packet;
  HitPacket hits;
};

template <class Spu> class HitQueue {
public:
  explicit HitQueue(Spu& spu) : packets_(spu.template allocate<QueuedHits>(kPackets)) {}

  bool empty() const { return count_ == 0; }
  /// Whether a packet is full.
  bool full() const { return count_ >= kSimdLanes; }

  /// Adds some rays of a node. False: there is no room for them, or they are as well off by themselves.
  bool add(const RayNode& node, const WordLanes& pixels, const HitPacket& hits, uint32_t lanes) {
    const auto more = static_cast<uint32_t>(__builtin_popcount(lanes));
    if (more >= static_cast<uint32_t>(tuning::kLeastRaysByThemselves) ||
        count_ + more > kPackets * kSimdLanes)
      return false;
    for_each_lane(lanes, [&](uint32_t lane) {
      const uint32_t to = count_ % kSimdLanes;
      QueuedHits& packet = packets_[(first_ + count_++ / kSimdLanes) % kPackets];
      if (to == 0) packet.packet.node.begin();
      packet.packet.add(node, pixels, lane, to);
      copy_lane(hits, lane, packet.hits, to);
    });
    return true;
  }

  /// The packet to be shaded next; there is one. It stays where it is until hits are added.
  const QueuedHits& take() {
    const QueuedHits& taken = packets_[first_];
    first_ = (first_ + 1) % kPackets;
    count_ -= full() ? kSimdLanes : count_;
    return taken;
  }
  /// Forgets all hits.
  void clear() { count_ = 0; }

private:
  /// What a tree may leave until it is complete: packets are taken between trees.
  static constexpr uint32_t kPackets = 4;

  QueuedHits* packets_;            ///< a ring
  uint32_t first_ = 0, count_ = 0; ///< the packet that is the first; hits
};

} // namespace celltrace::kernel
