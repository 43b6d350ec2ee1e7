// Render ray packet: the sixteen rays through a 4x4 block of pixels. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/cameras/list.hpp"
#include "kernel/direct/bundle_view.hpp"
#include "kernel/modules.hpp"

#include <type_traits>

namespace celltrace::kernel {

namespace detail {
alignas(64) constexpr float kLaneX[kSimdLanes] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr float kLaneY[kSimdLanes] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
} // namespace detail

namespace module_cameras {

/// The rays of a curved camera, or of one that is far away; returns the lanes that have one.
template <class Spu>
CELLTRACE_ONE_COPY uint32_t bend(Spu& spu, const CameraRecord& camera, const typename Spu::simd::F& x,
                                 const typename Spu::simd::F& y, RayPacket& packet) {
  using S = typename Spu::simd;
  using F = typename S::F;
  spu.run_in_module(modules::kCameras);
  const bool is_far = camera.ahead != 0.0f;
  CameraRays<S> rays;
  rays.origin = splat3<S>(camera.origin);
  rays.x = x * F(camera.step_x);
  rays.y = (F(0.0f) - y) * F(camera.step_y);
  uint32_t lanes = 0xFFFF;
  bool turns = false;
  Cameras::dispatch(camera.kind, [&](auto kind) {
    using Kind = decltype(kind);
    if constexpr (Kind::kIsFlat)
      rays.direction = {rays.x, rays.y, F(1.0f)};
    else
      lanes = Kind::template bend<S>(camera, rays);
    turns = !is_far && std::is_same_v<Kind, SphericalCamera>;
  });
  if (is_far) {
    const F scale = F(camera.ahead) / rays.direction.z;
    rays.origin = rays.origin +
                  (splat3<S>(camera.dx) * rays.direction.x + splat3<S>(camera.dy) * rays.direction.y) * scale;
  }
  packet.origin.template store<S>(rays.origin);
  packet.direction.template store<S>(
      normalise<S>(turns ? SphericalCamera::turn<S>(camera, rays) : along_axes<S>(camera, rays.direction)));
  return lanes;
}

} // namespace module_cameras

/// Rays through points of the picture, `x` to the right of its middle and `y` below it, in pixels. Returns
/// the lanes that have one: not all cameras see something in every pixel. What those do not see is black.
template <class Spu>
uint32_t make_rays_through(Spu& spu, const CameraRecord& camera, const typename Spu::simd::F& x,
                           const typename Spu::simd::F& y, RayPacket& packet) {
  using S = typename Spu::simd;
  for (uint32_t lane = 0; lane < kSimdLanes; ++lane)
    packet.start_object.lane[lane] = kNoOffset;
  bool flat = false, parallel = false;
  Cameras::dispatch(camera.kind, [&](auto kind) {
    parallel = decltype(kind)::kShared == SharedByRays::direction;
    flat = decltype(kind)::kIsFlat && (parallel || camera.ahead == 0.0f);
  });
  if (!flat) {
    spu.enter_module(modules::kCameras);
    return module_cameras::bend(spu, camera, x, y, packet);
  }
  const V3<S> through = splat3<S>(camera.base) + splat3<S>(camera.dx) * x + splat3<S>(camera.dy) * y;
  const V3<S> fixed = splat3<S>(camera.origin);
  packet.origin.template store<S>(parallel ? through : fixed);
  packet.direction.template store<S>(normalise<S>(parallel ? fixed : through));
  return 0xFFFF;
}

/// Where the pixels of the packet at (column, row) are, both counted in packets. From the middle that the
/// record says: about it nothing cancels.
template <class S> typename S::F pixels_across(const FrameBlock& frame, uint32_t column) {
  using F = typename S::F;
  return F::load(detail::kLaneX) + F(static_cast<float>(column * kPacketEdge) - frame.camera.middle_x);
}
template <class S> typename S::F pixels_down(const FrameBlock& frame, uint32_t row) {
  using F = typename S::F;
  return F::load(detail::kLaneY) + F(static_cast<float>(row * kPacketEdge) - frame.camera.middle_y);
}

/// Rays of the packet at (column, row), as make_rays_through().
template <class Spu>
uint32_t make_primary_rays(Spu& spu, const FrameBlock& frame, uint32_t column, uint32_t row,
                           RayPacket& packet) {
  using S = typename Spu::simd;
  return make_rays_through(spu, frame.camera, pixels_across<S>(frame, column), pixels_down<S>(frame, row),
                           packet);
}

/// The primary rays of a bundle of 4x4 packets, if they leave one point through a plane into one octant; else
/// of no packets.
template <class S> class PinholeBundle : public ViewBundle<S> {
public:
  using F = typename S::F;
  using ViewBundle<S>::view, ViewBundle<S>::bounds, ViewBundle<S>::all, ViewBundle<S>::octant,
      ViewBundle<S>::packets;

  F shortening; ///< of unit directions: none is longer on the major axis

  PinholeBundle(const FrameBlock& frame, uint32_t column, uint32_t row) {
    if (!is_pinhole(frame.camera)) return;
    const CameraRecord& camera = frame.camera;
    constexpr float kBundle = kPacketEdge * kPacketEdge; // pixels
    const float middle_x = (static_cast<float>(column) + 0.5f) * kBundle - camera.middle_x;
    const float middle_y = (static_cast<float>(row) + 0.5f) * kBundle - camera.middle_y;
    uint32_t major = 0;
    float middle[3];
    for (uint32_t axis = 0; axis < 3; ++axis) {
      middle[axis] = camera.base[axis] + camera.dx[axis] * middle_x + camera.dy[axis] * middle_y;
      if (magnitude(middle[axis]) > magnitude(middle[major])) major = axis;
    }
    view.set_major(major);
    view.forth = middle[major] < 0.0f ? -1.0f : 1.0f;
    if (see(frame, static_cast<float>(column), static_cast<float>(row))) bound(camera);
  }

private:
  /// The rectangles are those around the directions through the corners of packets. False if some go another
  /// way along the major axis.
  bool see(const FrameBlock& frame, float column, float row) {
    constexpr float kEdge = kPacketEdge;
    const CameraRecord& camera = frame.camera;
    float rounding[3];
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t axis = view.axes[i];
      rounding[i] = 2e-6f * (magnitude(camera.base[axis]) +
                             magnitude(camera.dx[axis]) * static_cast<float>(frame.width) +
                             magnitude(camera.dy[axis]) * static_cast<float>(frame.height));
    }
    const F x = (F::load(detail::kLaneX) + F(column * kEdge)) * F(kEdge);
    const F y = (F::load(detail::kLaneY) + F(row * kEdge)) * F(kEdge);
    for (uint32_t corner = 0; corner < 4; ++corner) {
      const F right = x + F(((corner & 1) != 0 ? kEdge - 1 : 0.0f) - camera.middle_x);
      const F down = y + F(((corner & 2) != 0 ? kEdge - 1 : 0.0f) - camera.middle_y);
      const auto through = [&](uint32_t axis) {
        return F(camera.base[axis]) + F(camera.dx[axis]) * right + F(camera.dy[axis]) * down;
      };
      const F length = through(view.axes[2]) * F(view.forth);
      if ((length > F(2.0f * rounding[2])).bits() != 0xFFFF) return false;
      const F scale = F(1.0f) / length;
      for (uint32_t i = 0; i < 2; ++i) {
        const F along = through(view.axes[i]) * scale;
        const F off = (S::abs(along) * F(rounding[2]) + F(rounding[i])) * scale;
        LaneInterval<S>& seen = view.seen[i];
        seen.low = corner == 0 ? along - off : S::min(seen.low, along - off);
        seen.high = corner == 0 ? along + off : S::max(seen.high, along + off);
      }
    }
    return true;
  }

  void bound(const CameraRecord& camera) {
    F square(1.0f);
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t axis = view.axes[i];
      const float origin = camera.origin[axis];
      view.origin[axis] = origin;
      all.origin[axis] = {origin, origin};
      bounds.origin[axis] = LaneInterval<S>::splat(all.origin[axis]);
      const Interval straight = {view.forth, view.forth};
      const LaneInterval<S> direction = i < 2 ? view.seen[i] : LaneInterval<S>::splat(straight);
      bounds.direction[axis] = direction;
      all.direction[axis] = i < 2 ? direction.all() : straight;
      const bool backward = all.direction[axis].high < 0.0f;
      if (!backward && all.direction[axis].low < 0.0f) return;
      octant |= static_cast<uint32_t>(backward) << axis;
      const F least = backward ? direction.high : direction.low;
      if (i < 2) square = square + least * least;
    }
    shortening = F(1.000001f) / S::sqrt(square);
    packets = 0xFFFF;
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
