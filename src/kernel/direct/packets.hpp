// Packets where code takes no local store: what is short is inlined. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"

namespace celltrace::kernel {

struct DirectPackets {
  /// Whether there are shortcuts for what is frequent, and every accelerator in a program: code is free.
  static constexpr bool kHasShortcuts = true;

  template <class S>
  [[gnu::always_inline]] static void put_in_lanes(bool all, const typename S::M& lanes, const float* values,
                                                  V3<S>& into) {
    into = all ? splat3<S>(values) : select<S>(lanes, splat3<S>(values), into);
  }
  template <class Packet> [[gnu::always_inline]] static void copy_packet(const Packet& from, Packet& to) {
    to = from;
  }

  /// Changes words of some lanes, in a register until finish(): whoever loads them next would wait for stores
  /// by lane.
  template <class S> class WordChanges {
  public:
    explicit WordChanges(WordLanes& words) : words_(words), all_(load_words<S>(words)) {}
    [[gnu::always_inline]] void set(uint32_t lanes, uint32_t value) {
      all_ = S::select(S::M::from_bits(lanes), S::I::splat(static_cast<int32_t>(value)), all_);
    }
    void finish() { store_words<S>(words_, all_); }

  private:
    WordLanes& words_;
    typename S::I all_;
  };
};

} // namespace celltrace::kernel
