// Render ray packet: the sixteen rays through a 4x4 block of pixels. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"

namespace celltrace::kernel {

namespace detail {
alignas(64) constexpr float kLaneX[kSimdLanes] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr float kLaneY[kSimdLanes] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
} // namespace detail

/// Rays of the packet at (column, row), both counted in packets.
template <class S>
void make_primary_rays(const FrameBlock& frame, uint32_t column, uint32_t row, RayPacket& rays) {
  using F = typename S::F;
  const CameraRecord& camera = frame.camera;
  const F x = F::load(detail::kLaneX) + F(static_cast<float>(column * kPacketEdge));
  const F y = F::load(detail::kLaneY) + F(static_cast<float>(row * kPacketEdge));
  const V3<S> through = splat3<S>(camera.base) + splat3<S>(camera.dx) * x + splat3<S>(camera.dy) * y;
  const V3<S> fixed = splat3<S>(camera.origin);
  rays.origin.template store<S>(frame.orthographic != 0 ? through : fixed);
  rays.direction.template store<S>(normalise<S>(frame.orthographic != 0 ? fixed : through));
  for (uint32_t lane = 0; lane < kSimdLanes; ++lane)
    rays.start_object.lane[lane] = kNoOffset;
}

/// Lanes of the packet that lie in the picture.
inline uint32_t lanes_in_picture(const FrameBlock& frame, uint32_t column, uint32_t row) {
  const uint32_t columns = frame.width - column * kPacketEdge;
  const uint32_t rows = frame.height - row * kPacketEdge;
  const uint32_t in_row = columns >= kPacketEdge ? 0xFu : (1u << columns) - 1;
  uint32_t lanes = 0;
  for (uint32_t y = 0; y < kPacketEdge && y < rows; ++y)
    lanes |= in_row << (y * kPacketEdge);
  return lanes;
}

} // namespace celltrace::kernel
