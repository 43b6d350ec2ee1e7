// Cameras. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// Geometry of a camera's rays: `pinhole` rays leave one point through a plane, `parallel` rays leave a
/// plane, and `made` rays are computed by the code module of cameras.
enum class RaySheaf : uint32_t { pinhole, parallel, made };

/// Flat cameras: base + (x - middle_x)*dx + (y - middle_y)*dy belongs to pixel (x, y). The sum is the
/// direction (not normalised) of a ray from `origin`, or, for parallel rays, the origin of a ray in the
/// direction `origin`. `middle_y` may differ from the middle row.
///
/// Curved cameras: `origin` is the location; `base`, `dx` and `dy` are the axes forward, right and up. Pixel
/// (x, y) is at ((x - middle_x) * step_x, (middle_y - y) * step_y) of the camera's picture, and the kind of
/// camera turns this position into a ray.
///
/// Rays of a distant camera start just before the scene, in the plane at distance `ahead` along the unit
/// vector `base`. Unless these rays are parallel, `sheaf` is `made`, even if the camera is flat, and `origin`
/// is the start of the middle ray.
struct alignas(16) CameraRecord {
  float origin[3];
  uint32_t kind; ///< index of the camera's type in cameras/list.hpp
  float base[3];
  float bend; ///< parameter of a curved camera whose meaning depends on the kind
  float dx[3];
  float middle_x;
  float dy[3];
  float middle_y;
  float step_x, step_y;
  /// Distance along the camera's axis from the camera to the start of rays; 0: rays start at the camera. A
  /// ray starts ahead / dot(direction, axis) away from the camera; the axis is `base`, or `origin` for
  /// parallel rays.
  float ahead;
  uint32_t sheaf; ///< RaySheaf
};
static_assert(sizeof(CameraRecord) == 80, "crosses DMA");

} // namespace celltrace::kernel
