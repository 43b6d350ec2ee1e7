// All kinds of cameras. The order determines their numbers in records, and is that of Camera::Kind. Kernel
// dialect.
//
// A kind C has
//   kName
//   kIsFlat       true if pixels are evenly spaced in a plane
//   kShared       the common property of all its rays; for a flat camera the origin or the direction, and the
//                 plane determines the other one
// and if it is not flat
//   kHasUnitAxes          true if its axes are unit vectors
//   picture(view)         returns the extent of the picture
//   bend(record, rays)    computes directions, along the camera's axes, from positions on the picture, and
//                         origins if they are not the location. Returns the lanes that have a ray.
#pragma once

#include "kernel/cameras/cylinder.hpp"
#include "kernel/cameras/fisheye.hpp"
#include "kernel/cameras/omnimax.hpp"
#include "kernel/cameras/orthographic.hpp"
#include "kernel/cameras/panoramic.hpp"
#include "kernel/cameras/perspective.hpp"
#include "kernel/cameras/spherical.hpp"
#include "kernel/cameras/ultra_wide_angle.hpp"
#include "kernel/type_list.hpp"

namespace celltrace::kernel {

using Cameras = TypeList<PerspectiveCamera, OrthographicCamera, SphericalCamera, UltraWideAngleCamera,
                         OmnimaxCamera, PanoramicCamera, Cylinder1Camera, Cylinder2Camera, Cylinder3Camera,
                         Cylinder4Camera, FisheyeCamera>;
template <class C> constexpr uint32_t kCameraKind = Cameras::number<C>();

/// Returns true if all rays leave one point through a plane.
constexpr bool is_pinhole(const CameraRecord& camera) {
  return camera.sheaf == static_cast<uint32_t>(RaySheaf::pinhole);
}

/// Returns the distance from a distant camera to the start of its rays.
template <class S> typename S::F start_offset(const CameraRecord& camera, const V3<S>& direction) {
  const bool is_parallel = camera.sheaf == static_cast<uint32_t>(RaySheaf::parallel);
  return
      typename S::F(camera.ahead) / dot<S>(direction, splat3<S>(is_parallel ? camera.origin : camera.base));
}

} // namespace celltrace::kernel
