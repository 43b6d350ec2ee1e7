// Rays and what they hit: plain data that applications and the kernel share.
#pragma once

#include <stdint.h>

namespace celltrace {

/// As far as there is anything.
constexpr float kEndless = __builtin_inff();

/// From `origin` along `direction`, in the scene's coordinates.
struct Ray {
  float origin[3];
  float direction[3]; ///< 1e-18 to 1e18 long
  /// How far it reaches: hits there or beyond are none. In the scene's unit, whatever the direction's length.
  float tfar = kEndless;
};

/// The closest hit of a ray.
struct RayHit {
  static constexpr uint32_t kNone = 0xFFFFFFFF;

  float distance = kEndless; ///< in the scene's unit; infinity if nothing is hit
  /// Barycentric coordinates in a triangle: the shares of its second and third vertex. They mean nothing on
  /// other shapes.
  float u = 0.0f, v = 0.0f;
  uint32_t object = kNone; ///< index in Scene::objects, or kNone
  uint32_t record = kNone; ///< what of the object is hit; for RayQueries::surface()

  explicit operator bool() const { return object != kNone; }
};

/// A point on a surface.
struct RaySurface {
  float point[3];  ///< on the object, to its own precision
  float normal[3]; ///< of length 1, on the side that the ray comes from; interpolated where triangles are
                   ///< smooth
};

} // namespace celltrace
