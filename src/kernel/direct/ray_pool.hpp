// Rays of many ray trees in full packets. Kernel dialect, where memory is direct.
//
// Behind surfaces that mirror or bend rays most packets of a tree have few rays each. Those of all trees of a
// bundle are gathered here by the octants of their directions, and traced as many at a time as there are
// lanes.
#pragma once

#include "kernel/accel/frustum.hpp"
#include "kernel/shading/ray_stack.hpp"

namespace celltrace::kernel {

/// Rays of different trees, all of which go to their pixels' own light.
struct PooledPacket {
  RayNode node;
  WordLanes pixels; ///< of the bundle, by lane

  /// Takes a ray of a node into a lane.
  void add(const RayNode& from, const WordLanes& from_pixels, uint32_t lane, uint32_t to_lane) {
    copy_lane(from.rays, lane, node.rays, to_lane);
    copy_lane(from.throughput, lane, node.throughput, to_lane);
    copy_lane(from.weight, lane, node.weight, to_lane);
    copy_lane(from.level, lane, node.level, to_lane);
    copy_lane(from.power, lane, node.power, to_lane);
    copy_lane(static_cast<const RayInteriors&>(from), lane, static_cast<RayInteriors&>(node), to_lane);
    copy_lane(from_pixels, lane, pixels, to_lane);
    node.lanes |= 1u << to_lane;
    node.reflected |= (from.reflected >> lane & 1) << to_lane;
  }
};

/// Packets of rays, one of each octant being filled. Full ones are taken first, the youngest before the
/// others: so the pool holds few rays at any time.
template <class Spu> class RayPool {
public:
  explicit RayPool(Spu& spu) : packets_(spu.template allocate<PooledPacket>(kPackets)) { clear(); }

  bool empty() const { return full_ == 0 && filling_rays_ == 0; }
  void clear() {
    full_ = filling_rays_ = free_count_ = 0;
    while (free_count_ < kPackets) {
      free_[free_count_] = free_count_;
      ++free_count_;
    }
    for (uint32_t octant = 0; octant < kOctants; ++octant)
      begin_packet(octant);
  }

  /// Adds the rays of a node. False: they are as well off by themselves, or there is no room for them.
  bool add(const RayNode& node, const WordLanes& pixels) {
    if (__builtin_popcount(node.lanes) >= tuning::kLeastRaysByThemselves || free_count_ < kOctants)
      return false;
    for_each_lane(node.lanes, [&](uint32_t lane) {
      const uint32_t octant = octant_of(node.rays, lane);
      packets_[filling_[octant]].add(node, pixels, lane, count_[octant]++);
      ++filling_rays_;
      if (count_[octant] < kSimdLanes) return;
      full_packets_[full_++] = filling_[octant];
      filling_rays_ -= kSimdLanes;
      begin_packet(octant);
    });
    return true;
  }

  /// The packet to be traced next; there is one. It stays where it is until rays are added.
  const PooledPacket& take() {
    uint32_t taken;
    if (full_ != 0) {
      taken = full_packets_[--full_];
    } else {
      const uint32_t octant = fill_up();
      taken = filling_[octant];
      filling_rays_ -= count_[octant];
      begin_packet(octant);
    }
    free_[free_count_++] = taken;
    return packets_[taken];
  }

private:
  static constexpr uint32_t kOctants = 8;
  /// Those that are being filled, some for each packet of a bundle, and those that wait on the way down the
  /// trees.
  static constexpr uint32_t kPackets = 58;

  void begin_packet(uint32_t octant) {
    count_[octant] = 0;
    filling_[octant] = free_[--free_count_];
    packets_[filling_[octant]].node.begin();
  }

  /// Adds the rays of other packets to the one with the most rays, as long as there is room for all of one.
  /// Returns its octant.
  uint32_t fill_up() {
    uint32_t most = 0;
    for (uint32_t octant = 1; octant < kOctants; ++octant)
      if (count_[octant] > count_[most]) most = octant;
    PooledPacket& packet = packets_[filling_[most]];
    for (uint32_t octant = 0; octant < kOctants; ++octant) {
      if (octant == most || count_[most] + count_[octant] > kSimdLanes) continue;
      PooledPacket& other = packets_[filling_[octant]];
      for (uint32_t lane = 0; lane < count_[octant]; ++lane)
        packet.add(other.node, other.pixels, lane, count_[most]++);
      count_[octant] = 0;
      other.node.lanes = other.node.reflected = 0;
    }
    return most;
  }

  PooledPacket* packets_;
  // Numbers of packets.
  uint32_t free_[kPackets], free_count_ = 0;
  uint32_t full_packets_[kPackets], full_ = 0;
  uint32_t filling_[kOctants];

  uint32_t count_[kOctants];  ///< rays of packets that are being filled
  uint32_t filling_rays_ = 0; ///< all of them
};

/// The way of a tracer's rays into a pool.
template <class Spu> struct RayPooling {
  RayPool<Spu>* pool = nullptr;
  WordLanes pixels; ///< of the bundle, that the lanes of the rays are which are being traced

  /// False: they are to stay.
  bool takes(const RayNode& node) { return pool != nullptr && pool->add(node, pixels); }
};

} // namespace celltrace::kernel
