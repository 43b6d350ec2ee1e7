// Bounds of a bundle's primary rays for a pinhole camera, before the rays exist. Kernel dialect.
#pragma once

#include "kernel/cameras/primary_rays.hpp"
#include "kernel/direct/bundle_view.hpp"

namespace celltrace::kernel {

/// The primary rays of a bundle of 4x4 packets, if they leave one point through a plane into one octant;
/// otherwise without packets.
template <class S> class PinholeBundle : public ViewBundle<S> {
public:
  using F = typename S::F;
  using ViewBundle<S>::view, ViewBundle<S>::bounds, ViewBundle<S>::all, ViewBundle<S>::octant,
      ViewBundle<S>::packets;

  F shortening; ///< largest length of unit directions on the major axis

  PinholeBundle(const FrameBlock& frame, uint32_t column, uint32_t row) {
    if (!is_pinhole(frame.camera)) return;
    const CameraRecord& camera = frame.camera;
    constexpr float kBundle = kPacketEdge * kPacketEdge; // in pixels
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
  /// Computes the rectangles around the directions through the corners of packets. Returns false if some
  /// directions are opposite along the major axis.
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

} // namespace celltrace::kernel
