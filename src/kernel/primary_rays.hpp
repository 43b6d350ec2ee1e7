// Render ray packet: the sixteen rays through a 4x4 block of pixels. Kernel dialect.
#pragma once

#include "kernel/beam.hpp"

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

/// What the primary rays of a bundle of 4x4 packets have in common if they leave one point into one octant.
///
/// Their directions are taken in the plane of the picture, where they lie between those of the corners, and
/// in a scale in which none is shorter than 1: distances along them are not greater than along the unit
/// directions.
template <class S> struct PinholeBundle {
  RayBounds all;
  V3<S> low, high; ///< between which the directions are, a lane for each packet
  uint32_t octant = 0;
  bool exists = false; ///< if not, all else is meaningless

  PinholeBundle(const FrameBlock& frame, uint32_t column, uint32_t row) {
    using F = typename S::F;
    if (frame.orthographic != 0) return;
    const CameraRecord& camera = frame.camera;
    constexpr float kEdge = kPacketEdge, kBundle = kEdge * kEdge; // pixels
    const F x = (F::load(detail::kLaneX) + F(static_cast<float>(column) * kEdge)) * F(kEdge);
    const F y = (F::load(detail::kLaneY) + F(static_cast<float>(row) * kEdge)) * F(kEdge);
    F* const lows[3] = {&low.x, &low.y, &low.z};
    F* const highs[3] = {&high.x, &high.y, &high.z};
    float square = 0.0f; // of the shortest direction
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const float base = camera.base[axis], dx = camera.dx[axis], dy = camera.dy[axis];
      // Some pixels on, between which the rays are rounded otherwise.
      const float rounding = 1e-6f * (magnitude(base) + magnitude(dx) * static_cast<float>(frame.width) +
                                      magnitude(dy) * static_cast<float>(frame.height));
      const auto lowest = [&](float pixels) {
        return smaller(pixels * dx, 0.0f) + smaller(pixels * dy, 0.0f) - rounding;
      };
      const auto highest = [&](float pixels) {
        return larger(pixels * dx, 0.0f) + larger(pixels * dy, 0.0f) + rounding;
      };
      const F corners = F(base) + F(dx) * x + F(dy) * y;
      *lows[axis] = corners + F(lowest(kEdge - 1));
      *highs[axis] = corners + F(highest(kEdge - 1));
      const float corner =
          base + dx * (static_cast<float>(column) * kBundle) + dy * (static_cast<float>(row) * kBundle);
      const Interval along = {corner + lowest(kBundle - 1), corner + highest(kBundle - 1)};
      const bool backward = along.high < 0.0f;
      if (!backward && along.low < 0.0f) return;
      octant |= static_cast<uint32_t>(backward) << axis;
      const float least = backward ? along.high : along.low;
      square += least * least;
      all.origin[axis] = {camera.origin[axis], camera.origin[axis]};
      all.direction[axis] = along;
    }
    if (!(square > 1e-20f)) return;
    const F scale = F(1.000001f) / S::sqrt(F(square));
    low = low * scale;
    high = high * scale;
    FloatLanes scales;
    scale.store(scales.lane);
    for (Interval& along : all.direction)
      along = {along.low * scales.lane[0], along.high * scales.lane[0]};
    exists = true;
  }
};

/// Lanes of the packet that lie in the picture.
inline uint32_t lanes_in_picture(const FrameBlock& frame, uint32_t column, uint32_t row) {
  if ((column + 1) * kPacketEdge <= frame.width && (row + 1) * kPacketEdge <= frame.height) return 0xFFFF;
  const uint32_t columns = frame.width - column * kPacketEdge;
  const uint32_t rows = frame.height - row * kPacketEdge;
  const uint32_t in_row = columns >= kPacketEdge ? 0xFu : (1u << columns) - 1;
  uint32_t lanes = 0;
  for (uint32_t y = 0; y < kPacketEdge && y < rows; ++y)
    lanes |= in_row << (y * kPacketEdge);
  return lanes;
}

} // namespace celltrace::kernel
