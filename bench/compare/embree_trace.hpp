// A frame with Embree: primary rays, a shadow ray for each hit that faces the light, diffuse shading.
#pragma once

#include <embree3/rtcore.h>

#include "celltrace/ray.hpp"

#include <cstddef>
#include <cstdint>

namespace celltrace::compare {

/// The ray through pixel (x, y) goes from `origin` along base + x*dx + y*dy, not normalised.
struct EmbreeFrame {
  RTCScene scene = nullptr;
  int packet = 16;
  int size = 0;
  float origin[3], base[3], dx[3], dy[3], light[3];
  std::uint8_t* rgba = nullptr;
};

/// Renders pixel rows [4*tile_row, 4*tile_row + 4); returns the number of shadow rays. Several threads may
/// render different rows.
std::uint64_t trace_tile_row(const EmbreeFrame& frame, int tile_row);

/// The distances to the closest hits by rtcIntersect1(); infinity where nothing is hit.
void intersect_one_by_one(RTCScene scene, const Ray* rays, float* distances, std::size_t count);

/// While it lives, denormals count as zero on this thread, as Embree's manual demands.
class DenormalsAreZero {
public:
  DenormalsAreZero();
  ~DenormalsAreZero();
  DenormalsAreZero(const DenormalsAreZero&) = delete;
  DenormalsAreZero& operator=(const DenormalsAreZero&) = delete;

private:
  unsigned before_;
};

} // namespace celltrace::compare
