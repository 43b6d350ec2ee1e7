// Input and output of the kinds of cameras. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/packet.hpp"
#include "records/camera.hpp"

namespace celltrace::kernel {

/// The common property of all rays of a camera.
enum class SharedByRays { origin, direction, nothing };

/// Traits of curved cameras; a kind redefines the traits in which it differs; see list.hpp.
struct CurvedCamera {
  static constexpr bool kIsFlat = false;
  static constexpr bool kHasUnitAxes = true;
  static constexpr SharedByRays kShared = SharedByRays::origin;
};

/// Parameters from which a kind of curved camera computes its CameraPicture.
struct CameraView {
  double angle, vertical_angle; ///< radians
  double width, height;         ///< lengths of right and up
};
/// The extent of a curved camera's picture: half a width to the left and right of the middle, and half a
/// height up and down.
struct CameraPicture {
  double half_width, half_height;
  double middle = 0; ///< vertical coordinate of the middle
  double bend = 0;   ///< CameraRecord::bend
};

/// The positions of a packet's rays on the picture of a curved camera, and the resulting rays.
template <class S> struct CameraRays {
  V3<S> origin;
  V3<S> direction;    ///< along the camera's axes: right, up and forward; of any length
  typename S::F x, y; ///< distance from the middle, in the units of the CameraPicture
};

/// Converts a vector along the axes of a camera to the scene's axes.
template <class S> V3<S> along_axes(const CameraRecord& camera, const V3<S>& v) {
  return splat3<S>(camera.dx) * v.x + splat3<S>(camera.dy) * v.y + splat3<S>(camera.base) * v.z;
}

} // namespace celltrace::kernel
