// The panoramic camera: a cylinder of 180 degrees and infinite height. Kernel dialect.
#pragma once

#include "kernel/cameras/spherical.hpp"

namespace celltrace::kernel {

struct PanoramicCamera : CurvedCamera {
  static constexpr const char* kName = "panoramic";
  static constexpr bool kHasUnitAxes = false;

  static constexpr CameraPicture picture(const CameraView&) {
    constexpr double kQuarter = 1.5707963267948966;
    return {kQuarter, kQuarter};
  }

  /// Computes a spherical camera's directions: the tangent of a row's angle, times the cosine, which is
  /// positive.
  template <class S> static uint32_t bend(const CameraRecord& camera, CameraRays<S>& rays) {
    return SphericalCamera::bend<S>(camera, rays);
  }
};

} // namespace celltrace::kernel
