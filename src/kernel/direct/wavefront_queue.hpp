// Wavefront queues: lanes of many packets that need the same work wait until they fill a packet, for which
// one body runs (Laine, Karras and Aila, Megakernels Considered Harmful, 2013). Kernel dialect, for direct
// memory.
#pragma once

#include "kernel/packet.hpp"

namespace celltrace::kernel {

/// The base class of kinds of work, with defaults.
struct WorkKind {
  /// Number of packets that fill side by side: lanes of different keys stay apart.
  static constexpr uint32_t kKeys = 1;
  /// Capacity in packets. If it equals kKeys, a packet runs when it is full. If it is larger, full packets
  /// wait for run_next().
  static constexpr uint32_t kPackets = 1;
  /// True if run_next() takes the oldest full packet first, otherwise the youngest.
  static constexpr bool kOldestFirst = false;
  /// True if run_next() combines lanes of several keys when no packet is full.
  static constexpr bool kMixesKeys = false;
  /// Prepares a packet for its first lane.
  void begin() {}
};

/// Queues work of one kind, a WorkKind that has the data of its lanes as members, and
///
///   Source                     source of lanes
///   put(from, lanes, to)       copies `lanes` of a Source into the packet's lanes from `to` on, in order
///   source()                   returns the packet as a Source for other packets; only with kMixesKeys
///   run(key, lanes, worker...) the body: does the work of the packet's `lanes`, which are the first ones
///
/// Lanes of one key run in the order in which they were pushed, unless full packets wait for each other.
template <class Kind> class WavefrontQueue {
public:
  /// Makes a queue; `packets` has room for Kind::kPackets.
  explicit WavefrontQueue(Kind* packets) : packets_(packets) { clear(); }

  bool empty() const { return full_count_ == 0 && count_of_all() == 0; }
  bool has_full() const { return full_count_ != 0; }
  /// Returns true if all lanes of a packet can be pushed whatever their keys are; always, if full packets do
  /// not wait.
  bool has_room() const { return !kWaits || free_count_ >= kKeys; }

  /// Removes all lanes.
  void clear() {
    full_count_ = 0;
    for (free_count_ = 0; free_count_ < kPackets; ++free_count_)
      free_[free_count_] = free_count_;
    for (uint32_t key = 0; key < kKeys; ++key)
      begin_packet(key);
  }

  /// Adds some lanes, for which there must be room. Calls the body for each packet that becomes full, unless
  /// full packets wait. The body must not push.
  template <class... Worker>
  void push(uint32_t key, uint32_t lanes, const typename Kind::Source& from, Worker&&... worker) {
    while (lanes != 0) {
      Kind& packet = packets_[filling_[key]];
      uint32_t& count = count_[key];
      if (count == 0) packet.begin();
      const uint32_t next = lowest(lanes, kSimdLanes - count);
      packet.put(from, next, count);
      lanes &= ~next;
      count += static_cast<uint32_t>(__builtin_popcount(next));
      if (count < kSimdLanes) return;
      if constexpr (kWaits) {
        full_[full_count_++] = {filling_[key], key};
        begin_packet(key);
      } else {
        count = 0;
        packet.run(key, kAll, worker...);
      }
    }
  }

  /// Calls the body for the next packet, which must exist; it may have few lanes if none is full. Returns the
  /// result of the body, which may push.
  template <class... Worker> auto run_next(Worker&&... worker) {
    uint32_t lanes = kAll;
    const Packet next = has_full() ? take_full() : take_filling(lanes);
    if constexpr (kWaits) free_[free_count_++] = next.number;
    return packets_[next.number].run(next.key, lanes, worker...);
  }
  /// Calls the body until nothing waits.
  template <class... Worker> void flush(Worker&&... worker) {
    while (!empty())
      run_next(worker...);
  }

private:
  static constexpr uint32_t kKeys = Kind::kKeys, kPackets = Kind::kPackets, kAll = (1u << kSimdLanes) - 1;
  static constexpr bool kWaits = kPackets > kKeys;
  static_assert(kPackets >= kKeys);

  struct Packet {
    uint32_t number, key;
  };

  /// Returns the lowest of some lanes, at most `most` of them.
  static uint32_t lowest(uint32_t lanes, uint32_t most) {
    while (static_cast<uint32_t>(__builtin_popcount(lanes)) > most)
      lanes &= ~(0x80000000u >> __builtin_clz(lanes));
    return lanes;
  }
  uint32_t count_of_all() const {
    uint32_t sum = 0;
    for (const uint32_t count : count_)
      sum += count;
    return sum;
  }
  void begin_packet(uint32_t key) {
    count_[key] = 0;
    filling_[key] = kWaits ? free_[--free_count_] : key;
  }
  Packet take_full() {
    --full_count_;
    if constexpr (Kind::kOldestFirst) {
      const Packet oldest = full_[0];
      for (uint32_t i = 0; i < full_count_; ++i)
        full_[i] = full_[i + 1];
      return oldest;
    }
    return full_[full_count_];
  }
  /// Takes a packet that is not full, with some `lanes`.
  Packet take_filling(uint32_t& lanes) {
    const uint32_t key = next_key();
    const Packet taken = {filling_[key], key};
    lanes = (1u << count_[key]) - 1;
    begin_packet(key);
    return taken;
  }
  /// Returns the first key with lanes; or, with kMixesKeys, the key with the most lanes, to which it adds all
  /// lanes of other keys if there is room for them.
  uint32_t next_key() {
    uint32_t next = 0;
    for (uint32_t key = 1; key < kKeys; ++key)
      if (Kind::kMixesKeys ? count_[key] > count_[next] : count_[next] == 0) next = key;
    if constexpr (Kind::kMixesKeys) {
      Kind& packet = packets_[filling_[next]];
      for (uint32_t key = 0; key < kKeys; ++key) {
        if (key == next || count_[next] + count_[key] > kSimdLanes) continue;
        packet.put(packets_[filling_[key]].source(), (1u << count_[key]) - 1, count_[next]);
        count_[next] += count_[key];
        count_[key] = 0;
      }
    }
    return next;
  }

  Kind* packets_;
  uint32_t free_[kPackets], free_count_ = 0; ///< numbers of packets, if full ones wait
  Packet full_[kPackets];
  uint32_t full_count_ = 0;
  uint32_t filling_[kKeys],
      count_[kKeys]; ///< index: key; packet that is being filled, and number of its lanes
};

} // namespace celltrace::kernel
