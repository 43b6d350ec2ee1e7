// The spherical camera: columns are longitudes, rows are latitudes. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/cameras/camera_view.hpp"

namespace celltrace::kernel {

struct SphericalCamera : CurvedCamera {
  static constexpr const char* kName = "spherical";

  static constexpr CameraPicture picture(const CameraView& view) {
    return {view.angle / 2, view.vertical_angle / 2};
  }

  /// Computes directions for axes at right angles, such as those of distant cameras.
  template <class S> static uint32_t bend(const CameraRecord&, CameraRays<S>& rays) {
    typename S::F sine_x, cosine_x, sine_y, cosine_y;
    sin_cos<S>(rays.x, sine_x, cosine_x);
    sin_cos<S>(rays.y, sine_y, cosine_y);
    rays.direction = {sine_x * cosine_y, sine_y, cosine_x * cosine_y};
    return 0xFFFF;
  }

  /// Returns directions in the scene. As in POV-Ray, forward turns about right and then about up, whatever
  /// angles the axes have: a camera of the other handedness sees upside down.
  template <class S> static V3<S> turn(const CameraRecord& camera, const CameraRays<S>& rays) {
    const typename S::F zero(0.0f);
    const V3<S> raised = turned<S>(splat3<S>(camera.base), splat3<S>(camera.dx), zero - rays.y);
    return turned<S>(raised, splat3<S>(camera.dy), rays.x);
  }

private:
  /// Returns `v` turned about a unit vector, by Rodrigues's formula.
  template <class S>
  CELLTRACE_ONE_COPY static V3<S> turned(const V3<S>& v, const V3<S>& axis, const typename S::F& angle) {
    typename S::F sine, cosine;
    sin_cos<S>(angle, sine, cosine);
    return v * cosine + cross<S>(axis, v) * sine + axis * (dot<S>(axis, v) * (typename S::F(1.0f) - cosine));
  }
};

} // namespace celltrace::kernel
