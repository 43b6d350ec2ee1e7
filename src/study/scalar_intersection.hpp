// Intersection of one ray with one object in scalar code, for comparison with packets.
// Kernel dialect.
#pragma once

#include "celltrace/spe/spu.hpp"

namespace celltrace::study {

struct ScalarRay {
  float origin[3], direction[3];
};

namespace detail {

inline float dot(const float (&a)[3], const float (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline void cross(const float (&a)[3], const float (&b)[3], float (&out)[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

} // namespace detail

/// Returns true if the ray hits the sphere around geometry[0..2] with radius geometry[3], and the distances
/// of both crossings. `root` is the machine's square root.
template <class Root>
inline bool hits_sphere(const ScalarRay& ray, const float* geometry, float (&distance)[2], Root root) {
  const float to_centre[3] = {geometry[0] - ray.origin[0], geometry[1] - ray.origin[1],
                              geometry[2] - ray.origin[2]};
  const float along = detail::dot(to_centre, ray.direction);
  const float aside[3] = {to_centre[0] - ray.direction[0] * along, to_centre[1] - ray.direction[1] * along,
                          to_centre[2] - ray.direction[2] * along};
  const float square = geometry[3] * geometry[3] - detail::dot(aside, aside);
  if (square < 0.0f) return false;
  const float half = root(square);
  distance[0] = along - half;
  distance[1] = along + half;
  return true;
}

/// Returns true if the ray hits the triangle of geometry[0..8] (Moeller and Trumbore 1997).
inline bool hits_triangle(const ScalarRay& ray, const float* geometry, float& distance) {
  const float edge1[3] = {geometry[3] - geometry[0], geometry[4] - geometry[1], geometry[5] - geometry[2]};
  const float edge2[3] = {geometry[6] - geometry[0], geometry[7] - geometry[1], geometry[8] - geometry[2]};
  float p[3], q[3];
  detail::cross(ray.direction, edge2, p);
  const float determinant = detail::dot(edge1, p);
  if (determinant < 1e-30f && determinant > -1e-30f) return false;
  const float inverse = 1.0f / determinant;
  const float from_v0[3] = {ray.origin[0] - geometry[0], ray.origin[1] - geometry[1],
                            ray.origin[2] - geometry[2]};
  const float u = detail::dot(from_v0, p) * inverse;
  if (u < 0.0f || u > 1.0f) return false;
  detail::cross(from_v0, edge1, q);
  const float v = detail::dot(ray.direction, q) * inverse;
  if (v < 0.0f || u + v > 1.0f) return false;
  distance = detail::dot(edge2, q) * inverse;
  return true;
}

} // namespace celltrace::study
