// Parallel rays from a plane. Kernel dialect.
#pragma once

#include "kernel/cameras/camera_view.hpp"

namespace celltrace::kernel {

struct OrthographicCamera {
  static constexpr const char* kName = "orthographic";
  static constexpr bool kIsFlat = true;
  static constexpr SharedByRays kShared = SharedByRays::direction;

  template <class S> static void aim(const CameraRecord& camera, CameraRays<S>& rays) {
    rays.origin = at_pixel<S>(camera, rays);
    rays.direction = splat3<S>(camera.origin);
  }
};

} // namespace celltrace::kernel
