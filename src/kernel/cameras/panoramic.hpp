// The panoramic camera: a cylinder of 180 degrees and infinite height. Kernel dialect.
#pragma once

#include "kernel/cameras/camera_view.hpp"

namespace celltrace::kernel {

struct PanoramicCamera {
  static constexpr const char* kName = "panoramic";
  static constexpr bool kIsFlat = false;
  static constexpr bool kHasUnitAxes = false;
  static constexpr SharedByRays kShared = SharedByRays::origin;

  static constexpr CameraPicture picture(const CameraView&) {
    constexpr double kQuarter = 1.5707963267948966;
    return {kQuarter, kQuarter};
  }

  template <class S> static uint32_t bend(const CameraRecord&, CameraRays<S>& rays) {
    typename S::F sine_x, cosine_x, sine_y, cosine_y;
    sin_cos<S>(rays.x, sine_x, cosine_x);
    sin_cos<S>(rays.y, sine_y, cosine_y);
    // All components are multiplied by the cosine, which is positive, as the tangent may be large.
    rays.direction = {sine_x * cosine_y, sine_y, cosine_x * cosine_y};
    return 0xFFFF;
  }
};

} // namespace celltrace::kernel
