// Cameras that project onto a standing or lying cylinder, seen from its middle or from its axis. Kernel
// dialect.
#pragma once

#include "kernel/cameras/camera_view.hpp"

namespace celltrace::kernel {

namespace detail {

/// Columns are angles, rows are heights.
struct StandingCylinder : CurvedCamera {
  static constexpr CameraPicture picture(const CameraView& view) { return {view.angle / 2, view.height / 2}; }
};
/// Rows are angles, columns are widths.
struct LyingCylinder : CurvedCamera {
  static constexpr CameraPicture picture(const CameraView& view) { return {view.width / 2, view.angle / 2}; }
};

} // namespace detail

/// POV-Ray's `cylinder 1`: a standing cylinder seen from a point.
struct Cylinder1Camera : detail::StandingCylinder {
  static constexpr const char* kName = "cylinder 1";

  template <class S> static uint32_t bend(const CameraRecord&, CameraRays<S>& rays) {
    typename S::F sine, cosine;
    sin_cos<S>(rays.x, sine, cosine);
    rays.direction = {sine, rays.y, cosine};
    return 0xFFFF;
  }
};

/// POV-Ray's `cylinder 2`: a lying cylinder seen from a point.
struct Cylinder2Camera : detail::LyingCylinder {
  static constexpr const char* kName = "cylinder 2";

  template <class S> static uint32_t bend(const CameraRecord&, CameraRays<S>& rays) {
    typename S::F sine, cosine;
    sin_cos<S>(rays.y, sine, cosine);
    rays.direction = {rays.x, sine, cosine};
    return 0xFFFF;
  }
};

/// POV-Ray's `cylinder 3`: a standing cylinder, each row seen from its own height.
struct Cylinder3Camera : detail::StandingCylinder {
  static constexpr const char* kName = "cylinder 3";
  static constexpr SharedByRays kShared = SharedByRays::nothing;

  template <class S> static uint32_t bend(const CameraRecord& camera, CameraRays<S>& rays) {
    typename S::F sine, cosine;
    sin_cos<S>(rays.x, sine, cosine);
    rays.origin = rays.origin + splat3<S>(camera.dy) * rays.y;
    rays.direction = {sine, typename S::F(0.0f), cosine};
    return 0xFFFF;
  }
};

/// POV-Ray's `cylinder 4`: a lying cylinder, each column seen from its own position.
struct Cylinder4Camera : detail::LyingCylinder {
  static constexpr const char* kName = "cylinder 4";
  static constexpr SharedByRays kShared = SharedByRays::nothing;

  template <class S> static uint32_t bend(const CameraRecord& camera, CameraRays<S>& rays) {
    typename S::F sine, cosine;
    sin_cos<S>(rays.y, sine, cosine);
    rays.origin = rays.origin + splat3<S>(camera.dx) * rays.x;
    rays.direction = {typename S::F(0.0f), sine, cosine};
    return 0xFFFF;
  }
};

} // namespace celltrace::kernel
