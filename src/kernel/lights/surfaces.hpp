// Surfaces as seen by the rays of a packet. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"

namespace celltrace::kernel {

/// Surfaces as seen by sixteen rays.
template <class S> struct Surfaces {
  V3<S> point, normal;      ///< normal flipped toward the viewer
  V3<S> direction;          ///< direction of the arriving rays
  const WordLanes* objects; ///< objects that the points lie on
  uint32_t any_side = 0;    ///< lanes that receive light from all sides
  uint32_t lit_through = 0; ///< lanes in which light from behind counts as if it came from the front
};

template <class Spu>
[[gnu::always_inline]] inline decltype(auto) part_of(const Surfaces<typename Spu::simd>& s, uint32_t first) {
  return whole_or<Spu>(
      s, [&]() __attribute__((always_inline)) {
        return Surfaces<typename Spu::rare_simd>{
            part_of<Spu>(s.point, first),     part_of<Spu>(s.normal, first),
            part_of<Spu>(s.direction, first), s.objects,
            part_of<Spu>(s.any_side, first),  part_of<Spu>(s.lit_through, first)};
      });
}

} // namespace celltrace::kernel
