// Cameras. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// How a camera's rays lie to each other: from one point through a plane, parallel from a plane, or as the
/// code module of cameras makes them.
enum class RaySheaf : uint32_t { pinhole, parallel, made };

/// Flat cameras: through pixel (x, y) goes base + (x - middle_x)*dx + (y - middle_y)*dy, as a direction from
/// `origin` (not normalised) or as an origin with direction `origin`; `middle_y` may be another row than that
/// in the middle. Curved ones: `origin` is their location, and `base`, `dx` and `dy` are their axes forward,
/// right and up; pixel (x, y) is at ((x - middle_x) * step_x, (middle_y - y) * step_y) of their picture,
/// which the kind turns into a ray.
///
/// Rays of a camera that is far away start just before the scene, in the plane that is `ahead` away along the
/// unit vector `base`. Unless they are parallel they are then made as those of curved cameras are, flat ones
/// too, and `origin` is where the middle one starts.
struct alignas(16) CameraRecord {
  float origin[3];
  uint32_t kind; ///< its place in the list of cameras/list.hpp
  float base[3];
  float bend; ///< curved: what else the kind needs
  float dx[3];
  float middle_x;
  float dy[3];
  float middle_y;
  float step_x, step_y;
  /// 0: rays start at the camera. A ray starts ahead / dot(direction, axis) away from it, where the axis is
  /// `base`, or `origin` of parallel rays.
  float ahead;
  uint32_t sheaf; ///< RaySheaf
};
static_assert(sizeof(CameraRecord) == 80, "crosses DMA");

} // namespace celltrace::kernel
