// The fisheye camera: a round picture in which the distance from the middle is proportional to the angle from
// the direction of view. Kernel dialect.
#pragma once

#include "kernel/cameras/round_picture.hpp"

namespace celltrace::kernel {

struct FisheyeCamera : CurvedCamera {
  static constexpr const char* kName = "fisheye";

  static constexpr CameraPicture picture(const CameraView& view) {
    return {view.width, view.height, 0, view.angle / 2};
  }

  template <class S> static uint32_t bend(const CameraRecord& camera, CameraRays<S>& rays) {
    using F = typename S::F;
    const RoundPicture<S> at(rays);
    F sine, cosine;
    sin_cos<S>(at.radius * F(camera.bend), sine, cosine);
    rays.direction = {at.right * sine, at.up * sine, cosine};
    return at.lanes;
  }
};

} // namespace celltrace::kernel
