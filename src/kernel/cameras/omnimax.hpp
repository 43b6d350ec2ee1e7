// The omnimax camera: a fisheye's half dome as Omnimax projectors show it, cut off below. Kernel dialect.
#pragma once

#include "kernel/cameras/round_picture.hpp"

namespace celltrace::kernel {

struct OmnimaxCamera : CurvedCamera {
  static constexpr const char* kName = "omnimax";

  /// Returns the picture's extent. The circle of radius 1 fits the width, and from an aspect ratio of 1 on
  /// also the top.
  static constexpr CameraPicture picture(const CameraView& view) {
    constexpr double kWidest = 1.283458; // aspect ratio at which the circle touches the sides
    const double aspect = view.height > 0 ? view.width / view.height : 1;
    if (aspect <= 1) return {1, aspect > 0 ? 1 / aspect : 0};
    const double squeezed = aspect < kWidest ? aspect : kWidest;
    return {aspect > kWidest ? aspect / kWidest : 1, 1 / squeezed, 1 - 1 / squeezed};
  }

  template <class S> static uint32_t bend(const CameraRecord&, CameraRays<S>& rays) {
    using F = typename S::F;
    const RoundPicture<S> at(rays);
    const F r2 = at.radius * at.radius;
    F sine, cosine;
    sin_cos<S>(at.radius * (F(1.411269f) + r2 * (F(-0.09439f) + r2 * F(0.25674f))), sine, cosine);
    const F up = at.up * sine;
    rays.direction = {at.right * sine, up, cosine};
    // Rays more than 45 degrees below the horizon are cut off.
    return at.lanes & (up + cosine >= F(0.0f)).bits();
  }
};

} // namespace celltrace::kernel
