// A ray packet against one object: the geometric sphere test (Haines, in Glassner, An Introduction to Ray
// Tracing), the same on the unit sphere for ellipsoids, and a triangle test by Pluecker coordinates, which
// leaves no gaps between neighbours. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/packet.hpp"
#include "kernel/records.hpp"

namespace celltrace::kernel {

/// Where a packet crosses a surface: two crossings of a (closed) sphere, at most one of a triangle. Distances
/// of lanes outside their mask are meaningless.
template <class S> struct Crossings {
  typename S::F near, far;
  typename S::M near_hit, far_hit;
  typename S::F u, v; ///< barycentric weights of the second and third vertex
};

/// POV-Ray's limits of a valid hit.
constexpr float kMinHitDistance = 1e-4f;
constexpr float kMaxHitDistance = 1e7f;

namespace detail {

/// The crossings with a sphere around the point that is `half_chord_centre` along the ray, `square` = (half
/// chord)^2. A ray that starts on the sphere leaves it at twice that distance, exactly, whatever rounding
/// says of the start.
template <class S>
Crossings<S> chord(const typename S::F& half_chord_centre, const typename S::F& square,
                   const typename S::M& starts_here) {
  using F = typename S::F;
  const auto meets = square >= F(0.0f);
  const F half = S::sqrt(S::max(square, F(0.0f)));
  Crossings<S> c;
  c.near = half_chord_centre - half;
  c.far = S::select(starts_here, half_chord_centre + half_chord_centre, half_chord_centre + half);
  c.near_hit = meets & !starts_here;
  c.far_hit = meets | starts_here;
  c.u = F(0.0f);
  c.v = F(0.0f);
  return c;
}

} // namespace detail

template <class S>
Crossings<S> intersect_sphere(const V3<S>& origin, const V3<S>& direction, const typename S::M& starts_here,
                              const ObjectRecord& object) {
  using F = typename S::F;
  const V3<S> to_centre = splat3<S>(object.geometry) - origin;
  const F along = dot<S>(to_centre, direction);
  // The perpendicular itself, not |to_centre|^2 - along^2: the difference of two large squares loses small
  // spheres that are far away.
  const V3<S> perpendicular = to_centre - direction * along;
  const F radius(object.geometry[3]);
  return detail::chord<S>(along, radius * radius - dot<S>(perpendicular, perpendicular), starts_here);
}

/// A point or direction in the space in which the ellipsoid is the unit sphere.
template <class S> V3<S> to_unit_sphere(const ObjectRecord& object, const V3<S>& v, float w) {
  using F = typename S::F;
  const float* m = object.geometry;
  return {F(m[0]) * v.x + F(m[1]) * v.y + F(m[2]) * v.z + F(m[3] * w),
          F(m[4]) * v.x + F(m[5]) * v.y + F(m[6]) * v.z + F(m[7] * w),
          F(m[8]) * v.x + F(m[9]) * v.y + F(m[10]) * v.z + F(m[11] * w)};
}

template <class S>
Crossings<S> intersect_ellipsoid(const V3<S>& origin, const V3<S>& direction,
                                 const typename S::M& starts_here, const ObjectRecord& object) {
  using F = typename S::F;
  const V3<S> o = to_unit_sphere<S>(object, origin, 1.0f);
  const V3<S> d = to_unit_sphere<S>(object, direction, 0.0f);
  const F inverse_square = F(1.0f) / S::max(dot<S>(d, d), F(1e-30f));
  const F along = -dot<S>(o, d) * inverse_square;
  const V3<S> nearest = o + d * along;
  return detail::chord<S>(along, (F(1.0f) - dot<S>(nearest, nearest)) * inverse_square, starts_here);
}

/// Compares the signed volumes that the ray spans with the triangle's edges (Pluecker coordinates). An edge
/// that two triangles share gives the same volume in both, to the last bit, with opposite signs: no ray slips
/// between them.
template <class S>
Crossings<S> intersect_triangle(const V3<S>& origin, const V3<S>& direction, const typename S::M& starts_here,
                                const ObjectRecord& object) {
  using F = typename S::F;
  const float* g = object.geometry;
  const float edge0[3] = {g[3] - g[0], g[4] - g[1], g[5] - g[2]};
  const float edge1[3] = {g[6] - g[3], g[7] - g[4], g[8] - g[5]};
  const float edge2[3] = {g[0] - g[6], g[1] - g[7], g[2] - g[8]};
  const float plane[3] = {edge0[1] * edge1[2] - edge0[2] * edge1[1],
                          edge0[2] * edge1[0] - edge0[0] * edge1[2],
                          edge0[0] * edge1[1] - edge0[1] * edge1[0]};
  const V3<S> v0 = splat3<S>(g) - origin;
  const V3<S> v1 = splat3<S>(g + 3) - origin;
  const V3<S> v2 = splat3<S>(g + 6) - origin;
  // Twice an edge's middle, crossed with the edge: its two ends, nearly parallel from afar, would cancel out.
  const F weight0 = dot<S>(direction, cross<S>(v1 + v2, splat3<S>(edge1)));
  const F weight1 = dot<S>(direction, cross<S>(v2 + v0, splat3<S>(edge2)));
  const F weight2 = dot<S>(direction, cross<S>(v0 + v1, splat3<S>(edge0)));
  const F volume = weight0 + weight1 + weight2; // 2 direction . plane
  const F zero(0.0f);
  const auto within = (S::min(weight0, S::min(weight1, weight2)) >= zero) |
                      (S::max(weight0, S::max(weight1, weight2)) <= zero);
  const auto crosses = S::abs(volume) > F(1e-30f);
  const F inverse = F(1.0f) / S::select(crosses, volume, F(1.0f));
  const F height = dot<S>(v0, splat3<S>(plane));
  Crossings<S> c;
  c.u = weight1 * inverse;
  c.v = weight2 * inverse;
  c.near = (height + height) * inverse;
  c.far = c.near;
  c.near_hit = crosses & within & !starts_here;
  c.far_hit = S::M::none();
  return c;
}

/// `self` is the object's offset in the scene image, against which the packet's start objects are compared.
template <class S> Crossings<S> intersect(const RayPacket& rays, const ObjectRecord& object, uint32_t self) {
  using I = typename S::I;
  const V3<S> origin = rays.origin.template load<S>();
  const V3<S> direction = rays.direction.template load<S>();
  const auto starts_here = I::load(reinterpret_cast<const int32_t*>(rays.start_object.lane)) ==
                           I::splat(static_cast<int32_t>(self));
  switch (static_cast<ObjectKind>(object.kind_and_flags & object_flag::kind_mask)) {
  case ObjectKind::sphere:
    return intersect_sphere<S>(origin, direction, starts_here, object);
  case ObjectKind::ellipsoid:
    return intersect_ellipsoid<S>(origin, direction, starts_here, object);
  default:
    return intersect_triangle<S>(origin, direction, starts_here, object);
  }
}

} // namespace celltrace::kernel
