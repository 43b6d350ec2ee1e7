// Packets where code takes no local store: short functions are inlined. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"

namespace celltrace::kernel {

struct DirectPackets {
  /// Returns the greatest distance of a search for hits: below 0 in lanes other than `lanes`, which then hit
  /// nothing, as tests of instances take long.
  template <class S> static typename S::F farthest(uint32_t lanes) {
    using F = typename S::F;
    return S::select(S::M::from_bits(lanes), F(kMaxHitDistance), F(-1.0f));
  }
  /// Returns a non-negative number raised to a power, which is mostly 2.
  template <class S> static typename S::F raised(const typename S::F& number, float power) {
    return power == 2.0f ? number * number : pow<S>(number, typename S::F(power));
  }

  template <class S>
  [[gnu::always_inline]] static void put_in_lanes(bool all, const typename S::M& lanes, const float* values,
                                                  V3<S>& into) {
    into = all ? splat3<S>(values) : select<S>(lanes, splat3<S>(values), into);
  }
  template <class Packet> [[gnu::always_inline]] static void copy_packet(const Packet& from, Packet& to) {
    to = from;
  }
};

} // namespace celltrace::kernel
