// Tests of single objects in local store, which has no room for shortcuts. Kernel dialect.
#pragma once

#include "kernel/accel/object_tests.hpp"

namespace celltrace::kernel {

template <class Tests, class Spu> class LocalObjectShortcuts {
protected:
  using S = typename Spu::simd;

  static void begin_occlusion(uint32_t) {}
  static void end_occlusion(uint32_t, uint32_t, uint32_t) {}
  static void clear_shadow_cache() {}
  [[gnu::always_inline]] static bool dims_at_once(const typename S::F&, const Crossings<S>&, uint32_t,
                                                  VectorLanes*&, uint32_t&) {
    return true;
  }
  static constexpr bool test_closest_shortly(const RayPacket&, const ObjectRecord&, uint32_t,
                                             const HitPacket&) {
    return false;
  }
  static constexpr bool test_occlusion_shortly(const RayPacket&, const ObjectRecord&, uint32_t,
                                               const FloatLanes&, const VectorLanes&, uint32_t) {
    return false;
  }
};

} // namespace celltrace::kernel
