// The ultra_wide_angle camera: angles take the place of a perspective picture's lengths. Kernel dialect.
#pragma once

#include "kernel/cameras/camera_view.hpp"

namespace celltrace::kernel {

struct UltraWideAngleCamera : CurvedCamera {
  static constexpr const char* kName = "ultra_wide_angle";

  static constexpr CameraPicture picture(const CameraView& view) {
    return {view.angle / 2, view.width > 0 ? view.angle / 2 * view.height / view.width : 0};
  }

  template <class S> static uint32_t bend(const CameraRecord&, CameraRays<S>& rays) {
    typename S::F sine_x, cosine_x, sine_y, cosine_y;
    sin_cos<S>(rays.x, sine_x, cosine_x);
    sin_cos<S>(rays.y, sine_y, cosine_y);
    rays.direction = {sine_x, sine_y, cosine_x * cosine_y};
    return 0xFFFF;
  }
};

} // namespace celltrace::kernel
