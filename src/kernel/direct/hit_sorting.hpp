// Sorting of a bundle's rays by the materials of their hits, so that few packets have several materials.
// Kernel dialect, for direct memory.
//
// A packet is shaded once for each of its materials, and hits with one material are mostly close together, so
// that their shadow rays are coherent. This is no WavefrontQueue, as no lane waits: all lanes are present at
// once and sorted by counting.
#pragma once

#include "kernel/packet.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

template <class Spu> class HitSorter {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;

  explicit HitSorter(Spu& spu) : sorted_(spu.template allocate<Sorted>(kPackets)) {}

  /// Sorts the rays and hits of a bundle's mixed packets into lanes from the first one on, if that pays.
  /// Other packets stay as they are. Returns the packets that were sorted.
  template <class Packet> uint32_t sort(SceneAccess<Spu>& scene, Packet* packets) {
    if (!looks_mixed(scene, packets)) return 0;
    materials_count_ = rays_ = mixed_ = sorted_count_ = 0;
    for (uint32_t& count : count_)
      count = 0;
    for (uint32_t i = 0; i < kPackets; ++i)
      classify(scene, packets[i].hits, packets[i].lanes, i);
    if (!pays()) return 0;
    for (uint32_t n = 0; n < sorted_count_; ++n) {
      const Packet& packet = packets[number_[n]];
      move(packet.rays, packet.hits, packet.lanes, number_[n]);
    }
    uint32_t sorted = 0;
    for (uint32_t n = 0; n < sorted_count_; ++n) {
      const uint32_t first = n * kSimdLanes, left = rays_ > first ? rays_ - first : 0;
      Packet& packet = packets[number_[n]];
      packet.lanes = left < kSimdLanes ? (1u << left) - 1 : 0xFFFF;
      packet.rays = sorted_[number_[n]].rays;
      packet.hits = sorted_[number_[n]].hits;
      sorted |= 1u << number_[n];
    }
    return sorted;
  }

  /// Returns the former places of the rays of packet `i`, which was sorted: lane + kSimdLanes x packet.
  const WordLanes& places(uint32_t i) const { return sorted_[i].places; }

private:
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;
  /// Number of materials that are distinguished. All further materials count as the last one; rays without a
  /// hit have kNone.
  static constexpr uint32_t kMaterials = 16, kNone = kMaterials;

  struct Sorted {
    RayPacket rays;
    HitPacket hits;
    WordLanes places;
  };

  /// Returns the material of an object. Triangles of instances count as one material, as theirs take long to
  /// find.
  static uint32_t material_at(SceneAccess<Spu>& scene, uint32_t object) {
    return is_instanced(object) ? kInstancedBit : scene.object(object)->material;
  }

  /// Returns true if enough packets have two corners with different materials.
  template <class Packet> static bool looks_mixed(SceneAccess<Spu>& scene, const Packet* packets) {
    uint32_t mixed = 0;
    for (uint32_t i = 0; i < kPackets; ++i) {
      if (packets[i].lanes != 0xFFFF) continue;
      const WordLanes& object = packets[i].hits.object;
      const uint32_t first = object.lane[0], last = object.lane[kSimdLanes - 1];
      if (first == last) continue;
      mixed += static_cast<uint32_t>(first == kNoOffset || last == kNoOffset ||
                                     material_at(scene, first) != material_at(scene, last));
    }
    return mixed >= tuning::kLeastMixedPackets;
  }

  /// Classifies the lanes of a packet that is to be sorted because it has hits of several materials, or also
  /// rays without a hit.
  void classify(SceneAccess<Spu>& scene, const HitPacket& hits, uint32_t lanes, uint32_t number) {
    uint32_t of_class[kMaterials + 1];
    uint32_t seen = 0;
    for_each_value<S>(hits.object, lanes, [&](uint32_t object, uint32_t same) {
      const uint32_t of = object == kNoOffset ? kNone : number_of(material_at(scene, object));
      of_class[of] = (seen >> of & 1) != 0 ? of_class[of] | same : same;
      seen |= 1u << of;
    });
    if ((seen & (seen - 1)) == 0) return;
    number_[sorted_count_++] = number;
    rays_ += static_cast<uint32_t>(__builtin_popcount(lanes));
    mixed_ += static_cast<uint32_t>(__builtin_popcount(seen & ~(1u << kNone)));
    for_each_lane(seen, [&](uint32_t of) {
      count_[of] += static_cast<uint32_t>(__builtin_popcount(of_class[of]));
      for_each_lane(of_class[of], [&](uint32_t lane) { class_[number][lane] = static_cast<uint8_t>(of); });
    });
  }
  uint32_t number_of(uint32_t material) {
    for (uint32_t i = 0; i < materials_count_; ++i)
      if (materials_[i] == material) return i;
    if (materials_count_ == kMaterials) return kMaterials - 1;
    materials_[materials_count_] = material;
    return materials_count_++;
  }

  /// Returns true if sorted packets have clearly fewer materials in total. Finds where the rays of each
  /// material begin.
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
      Sorted& sorted = sorted_[number_[place / kSimdLanes]];
      const uint32_t to = place % kSimdLanes;
      copy_lane(rays, lane, sorted.rays, to);
      copy_lane(hits, lane, sorted.hits, to);
      sorted.places.lane[to] = number * kSimdLanes + lane;
    });
  }

  Sorted* sorted_;
  uint32_t number_[kPackets], sorted_count_ = 0; ///< packets that are sorted
  uint8_t class_[kPackets][kSimdLanes];          ///< index: packet and lane; number of the material
  uint32_t materials_[kMaterials], materials_count_ = 0;
  uint32_t count_[kMaterials + 1],
      next_[kMaterials + 1]; ///< index: material; rays, and place of the next one
  uint32_t rays_ = 0;
  uint32_t mixed_ = 0; ///< sum of the sorted packets' numbers of materials
};

} // namespace celltrace::kernel
