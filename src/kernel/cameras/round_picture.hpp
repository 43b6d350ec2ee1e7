// A circle of radius 1, outside of which a picture has no rays. Kernel dialect.
#pragma once

#include "kernel/cameras/camera_view.hpp"

namespace celltrace::kernel {

template <class S> struct RoundPicture {
  typename S::F radius;    ///< how far from the middle
  typename S::F right, up; ///< the unit vector away from there; in the middle 0
  uint32_t lanes;          ///< inside

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
