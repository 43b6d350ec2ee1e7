// From a point through a plane. Kernel dialect.
#pragma once

#include "kernel/cameras/camera_view.hpp"

namespace celltrace::kernel {

struct PerspectiveCamera {
  static constexpr const char* kName = "perspective";
  static constexpr bool kIsFlat = true;
  static constexpr SharedByRays kShared = SharedByRays::origin;

  template <class S> static void aim(const CameraRecord& camera, CameraRays<S>& rays) {
    rays.origin = splat3<S>(camera.origin);
    rays.direction = at_pixel<S>(camera, rays);
  }
};

} // namespace celltrace::kernel
