// Sorts the rays of a bundle by the materials of what they hit, so that few packets have several. Kernel
// dialect, where memory is direct.
//
// A packet is shaded once for each of its materials; and what one material is on is mostly close together, so
// that the shadow rays from there are coherent.
#pragma once

#include "kernel/packet.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

template <class Spu> class HitSorter {
public:
  using S = typename Spu::simd;

  explicit HitSorter(Spu& spu) : sorted_(spu.template allocate<Sorted>(kPackets)) {}

  /// Sorts the packets of a bundle if that pays: rays, hits and the lanes that they have, which they then
  /// take from the first one on. Otherwise they stay as they are.
  template <class Packet> bool sort(SceneAccess<Spu>& scene, Packet* packets) {
    if (!looks_mixed(scene, packets)) return false;
    materials_count_ = rays_ = mixed_ = 0;
    for (uint32_t& count : count_)
      count = 0;
    for (uint32_t i = 0; i < kPackets; ++i)
      classify(scene, packets[i].hits, packets[i].lanes, class_[i]);
    if (!pays()) return false;
    for (uint32_t i = 0; i < kPackets; ++i)
      move(packets[i].rays, packets[i].hits, packets[i].lanes, i);
    for (uint32_t i = 0; i < kPackets; ++i) {
      const uint32_t first = i * kSimdLanes, left = rays_ > first ? rays_ - first : 0;
      packets[i].rays = sorted_[i].rays;
      packets[i].hits = sorted_[i].hits;
      packets[i].lanes = left < kSimdLanes ? (1u << left) - 1 : 0xFFFF;
    }
    return true;
  }

  /// Where the rays of packet `i` were before they were sorted: lane + kSimdLanes x packet.
  const WordLanes& places(uint32_t i) const { return sorted_[i].places; }

private:
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;
  /// Materials that are told apart. What has another one counts as the last of them, and what hits nothing
  /// has none.
  static constexpr uint32_t kMaterials = 16, kNone = kMaterials;

  struct Sorted {
    RayPacket rays;
    HitPacket hits;
    WordLanes places;
  };

  /// A glance at two corners of each packet.
  template <class Packet> static bool looks_mixed(SceneAccess<Spu>& scene, const Packet* packets) {
    uint32_t mixed = 0;
    for (uint32_t i = 0; i < kPackets; ++i) {
      if (packets[i].lanes != 0xFFFF) continue;
      const WordLanes& object = packets[i].hits.object;
      const uint32_t first = object.lane[0], last = object.lane[kSimdLanes - 1];
      if (first == last) continue;
      mixed += static_cast<uint32_t>(first == kNoOffset || last == kNoOffset ||
                                     scene.object(first)->material != scene.object(last)->material);
    }
    return mixed >= tuning::kLeastMixedPackets;
  }

  void classify(SceneAccess<Spu>& scene, const HitPacket& hits, uint32_t lanes,
                uint8_t (&classes)[kSimdLanes]) {
    uint32_t seen = 0;
    for_each_value<S>(hits.object, lanes, [&](uint32_t object, uint32_t same) {
      const uint32_t of = object == kNoOffset ? kNone : number_of(scene.object(object)->material);
      count_[of] += static_cast<uint32_t>(__builtin_popcount(same));
      seen |= 1u << of;
      for_each_lane(same, [&](uint32_t lane) { classes[lane] = static_cast<uint8_t>(of); });
    });
    rays_ += static_cast<uint32_t>(__builtin_popcount(lanes));
    mixed_ += static_cast<uint32_t>(__builtin_popcount(seen & ~(1u << kNone)));
  }
  uint32_t number_of(uint32_t material) {
    for (uint32_t i = 0; i < materials_count_; ++i)
      if (materials_[i] == material) return i;
    if (materials_count_ == kMaterials) return kMaterials - 1;
    materials_[materials_count_] = material;
    return materials_count_++;
  }

  /// Whether sorted packets have clearly fewer materials together. Finds where the rays with each begin.
  bool pays() {
    uint32_t place = 0, least = 0;
    for (uint32_t i = 0; i <= kNone; ++i) {
      if (i != kNone) least += (count_[i] + kSimdLanes - 1) / kSimdLanes;
      next_[i] = place;
      place += count_[i];
    }
    return 4 * mixed_ > 5 * least;
  }

  void move(const RayPacket& rays, const HitPacket& hits, uint32_t lanes, uint32_t number) {
    for_each_lane(lanes, [&](uint32_t lane) {
      const uint32_t place = next_[class_[number][lane]]++;
      Sorted& sorted = sorted_[place / kSimdLanes];
      const uint32_t to = place % kSimdLanes;
      copy_lane(rays, lane, sorted.rays, to);
      copy_lane(hits.distance, lane, sorted.hits.distance, to);
      copy_lane(hits.object, lane, sorted.hits.object, to);
      copy_lane(hits.u, lane, sorted.hits.u, to);
      copy_lane(hits.v, lane, sorted.hits.v, to);
      sorted.places.lane[to] = number * kSimdLanes + lane;
    });
  }

  Sorted* sorted_;
  uint8_t class_[kPackets][kSimdLanes]; ///< numbers of the materials that rays hit
  uint32_t materials_[kMaterials], materials_count_ = 0;
  uint32_t count_[kMaterials + 1], next_[kMaterials + 1]; ///< rays of each, and the next one's place
  uint32_t rays_ = 0;
  uint32_t mixed_ = 0; ///< materials of all packets together
};

} // namespace celltrace::kernel
