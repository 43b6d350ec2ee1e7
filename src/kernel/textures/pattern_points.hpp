// Points at which patterns are evaluated. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"
#include "kernel/parts.hpp"

namespace celltrace::kernel {

/// Further input of patterns besides points, for a packet: surface coordinates and normals in the lanes of
/// objects with object_flag::by_surface.
struct SurfaceLanes {
  FloatLanes u, v;    ///< surface coordinates
  VectorLanes normal; ///< unit vectors on the viewer's side, as disturbed so far
};

/// Points of a packet, or of a part of it.
template <class S> struct PatternPoints {
  V3<S> at;
  const SurfaceLanes* surface = nullptr; ///< surfaces of the whole packet; null: no pattern needs them
  uint32_t first = 0;                    ///< first lane of the part in the packet
};

template <class Spu>
[[gnu::always_inline]] inline decltype(auto) part_of(const PatternPoints<typename Spu::simd>& points,
                                                     uint32_t first) {
  return whole_or<Spu>(
      points, [&]() __attribute__((always_inline)) {
        return PatternPoints<typename Spu::rare_simd>{part_of<Spu>(points.at, first), points.surface, first};
      });
}

/// Returns the surface coordinates as points.
template <class S> V3<S> surface_coordinates(const PatternPoints<S>& points) {
  using F = typename S::F;
  return {F::load(points.surface->u.lane + points.first), F::load(points.surface->v.lane + points.first),
          F(0.0f)};
}

} // namespace celltrace::kernel
