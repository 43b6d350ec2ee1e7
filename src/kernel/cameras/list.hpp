// All kinds of cameras. The order gives each its number in records, and is that of Camera::Kind. Kernel
// dialect.
//
// A kind C has
//   kName
//   kIsFlat       whether pixels are in a plane, evenly
//   kShared       what all its rays have in common; if it is flat, origin or direction, and the plane gives
//                 the other
// and if it is not flat
//   kHasUnitAxes          whether its axes are of unit length
//   picture(view)         where its pixels are
//   bend(record, rays)    from the places on the picture the directions, along the camera's axes, and the
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

/// Whether all rays leave one point through a plane.
constexpr bool is_pinhole(const CameraRecord& camera) {
  return camera.sheaf == static_cast<uint32_t>(RaySheaf::pinhole);
}

/// How far rays of a camera that is far away start from it.
template <class S> typename S::F way_to_start(const CameraRecord& camera, const V3<S>& direction) {
  const bool is_parallel = camera.sheaf == static_cast<uint32_t>(RaySheaf::parallel);
  return
      typename S::F(camera.ahead) / dot<S>(direction, splat3<S>(is_parallel ? camera.origin : camera.base));
}

} // namespace celltrace::kernel
