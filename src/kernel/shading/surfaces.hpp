// Surfaces as seen by the rays of a packet. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"

namespace celltrace::kernel {

/// A surface as seen by sixteen rays.
template <class S> struct Surfaces {
  V3<S> point, normal;      ///< normal flipped toward the viewer
  V3<S> direction;          ///< of the rays that arrive
  const WordLanes* objects; ///< what the points lie on
  uint32_t any_side = 0; ///< lanes to which light may come from all sides, as their normals are not known yet
};

/// A part of them.
template <class Spu>
[[gnu::always_inline]] inline decltype(auto) part_of(const Surfaces<typename Spu::simd>& s,
                                                     [[maybe_unused]] uint32_t first) {
  if constexpr (kOnePart<Spu>)
    return (s);
  else
    return Surfaces<typename Spu::rare_simd>{part_of<Spu>(s.point, first), part_of<Spu>(s.normal, first),
                                             part_of<Spu>(s.direction, first), s.objects,
                                             part_of<Spu>(s.any_side, first)};
}

} // namespace celltrace::kernel
