// Rays and their hits: plain data that applications and the kernel share.
#pragma once

#include <stdint.h>

namespace celltrace {

/// Ray::tfar of a ray without an end.
constexpr float kEndless = __builtin_inff();

/// A ray from `origin` along `direction`, in the scene's coordinates.
struct Ray {
  float origin[3];
  float direction[3]; ///< of any length from 1e-18 to 1e18
  /// Distance at which the ray ends: hits there or beyond do not count. In the scene's unit, whatever the
  /// length of `direction`.
  float tfar = kEndless;
};

/// The closest hit of a ray.
struct RayHit {
  static constexpr uint32_t kNone = 0xFFFFFFFF;

  float distance = kEndless; ///< in the scene's unit; infinity if nothing is hit
  /// Barycentric coordinates in a triangle: the weights of its second and third vertex. Without meaning for
  /// other shapes.
  float u = 0.0f, v = 0.0f;
  uint32_t object = kNone; ///< index in Scene::objects, or kNone
  uint32_t record = kNone; ///< record of the part of the object that is hit; RayQueries::surface() needs it

  explicit operator bool() const { return object != kNone; }
};

/// The surface at a point that a ray hits.
struct RaySurface {
  float point[3];  ///< on the object's surface, as precisely as floats allow
  float normal[3]; ///< of length 1, on the side that the ray comes from; interpolated on smooth triangles
};

} // namespace celltrace
