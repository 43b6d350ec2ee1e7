// Packets where local store for code is scarce: functions that are not shorter than a call have one copy.
// Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/packet.hpp"

namespace celltrace::kernel {

struct LocalPackets {
  template <class S> static typename S::F farthest(uint32_t) { return typename S::F(kMaxHitDistance); }
  template <class S> static typename S::F raised(const typename S::F& number, float power) {
    return pow<S>(number, typename S::F(power));
  }

  template <class S>
  [[gnu::always_inline]] static void put_in_lanes(bool, const typename S::M& lanes, const float* values,
                                                  V3<S>& into) {
    put_elsewhere<S>(lanes, values, into);
  }
  /// Copies a packet by a call: inlined, each quadword would take two instructions.
  template <class Packet> [[gnu::always_inline]] static void copy_packet(const Packet& from, Packet& to) {
    copy_bytes(&to, &from, sizeof(Packet));
  }

private:
  template <class S>
  CELLTRACE_ONE_COPY static void put_elsewhere(const typename S::M& lanes, const float* values, V3<S>& into) {
    into = select<S>(lanes, splat3<S>(values), into);
  }
  CELLTRACE_ONE_COPY static void copy_bytes(void* to, const void* from, uint32_t bytes) {
    __builtin_memcpy(to, from, bytes);
  }
};

} // namespace celltrace::kernel
