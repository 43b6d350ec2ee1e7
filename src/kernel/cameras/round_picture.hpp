// Positions on a round picture, which has no rays outside a circle of radius 1. Kernel dialect.
#pragma once

#include "kernel/cameras/camera_view.hpp"

namespace celltrace::kernel {

template <class S> struct RoundPicture {
  typename S::F radius;    ///< distance from the middle
  typename S::F right, up; ///< unit vector away from the middle; 0 in the middle
  uint32_t lanes;          ///< lanes inside the circle

  explicit RoundPicture(const CameraRays<S>& rays) {
    using F = typename S::F;
    radius = S::sqrt(rays.x * rays.x + rays.y * rays.y);
    const F inverse = F(1.0f) / S::max(radius, F(1e-30f));
    right = rays.x * inverse;
    up = rays.y * inverse;
    lanes = (radius <= F(1.0f)).bits();
  }
};

} // namespace celltrace::kernel
