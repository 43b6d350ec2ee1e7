// What kinds of cameras make rays of. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/packet.hpp"
#include "records/camera.hpp"

namespace celltrace::kernel {

/// What all rays of a camera have in common.
enum class SharedByRays { origin, direction, nothing };

/// The picture of a curved camera: what kinds are told of it, by whom fills a CameraRecord.
struct CameraView {
  double angle, vertical_angle; ///< radians
  double width, height;         ///< lengths of right and up
};
/// Where its pixels are: from the middle it reaches half a width to both sides, and half a height.
struct CameraPicture {
  double half_width, half_height;
  double middle = 0; ///< the vertical coordinate there
  double bend = 0;   ///< of the record
};

/// Where the rays of a packet are on the picture of a curved camera, and what becomes of them.
template <class S> struct CameraRays {
  V3<S> origin;
  V3<S> direction;    ///< along the camera's axes: right, up and forward; of any length
  typename S::F x, y; ///< from the middle, in the units of the CameraPicture
};

/// A vector along the axes of a camera in the scene.
template <class S> V3<S> along_axes(const CameraRecord& camera, const V3<S>& v) {
  return splat3<S>(camera.dx) * v.x + splat3<S>(camera.dy) * v.y + splat3<S>(camera.base) * v.z;
}

} // namespace celltrace::kernel
