// A ray packet against one object: the geometric sphere test (Haines, in Glassner, An Introduction to Ray
// Tracing), the same on the unit sphere for ellipsoids, and the minimum-storage triangle test (Moeller and
// Trumbore 1997). Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/packet.hpp"
#include "kernel/records.hpp"
#include "kernel/scalar.hpp"

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

/// The rays that start on an object.
template <class S> typename S::M lanes_that_start_on(const RayPacket& rays, uint32_t self) {
  using I = typename S::I;
  return I::load(reinterpret_cast<const int32_t*>(rays.start_object.lane)) ==
         I::splat(static_cast<int32_t>(self));
}

namespace detail {

// What all tests of triangles have in common.
constexpr float kUnitInLastPlace = 6e-8f;
constexpr float kMaxOverlap = 1e-3f;        ///< of neighbours, in barycentric coordinates
constexpr float kLeastDeterminant = 1e-30f; ///< rays along the plane have less

} // namespace detail

/// A triangle for a packet of rays, or one for each lane.
template <class S> struct TriangleSides {
  V3<S> v0, edge1, edge2;

  static TriangleSides of(const ObjectRecord& object) {
    const float* g = object.geometry;
    const V3<S> corner = splat3<S>(g);
    return {corner, splat3<S>(g + 3) - corner, splat3<S>(g + 6) - corner};
  }
};

/// A triangle as seen from the origins of a packet's rays; what packets of one origin have in common.
///
/// Neighbours overlap by what the rounding of the barycentric coordinates may amount to, so that no ray slips
/// between them: that grows with the distance over the triangle's size, and as the ray gets parallel to it.
template <class S> class SeenTriangle {
public:
  using F = typename S::F;

  [[gnu::always_inline]] SeenTriangle(const V3<S>& origin, const TriangleSides<S>& sides)
      : edge1_(sides.edge1), edge2_(sides.edge2) {
    from_v0_ = origin - sides.v0;
    q_ = cross<S>(from_v0_, edge1_);
    distance_ = dot<S>(edge2_, q_);
    const F size = S::max(absolute_sum<S>(edge1_), absolute_sum<S>(edge2_));
    overlap_ = absolute_sum<S>(from_v0_) * (F(detail::kUnitInLastPlace) * size);
  }

  /// By rays of these directions.
  [[gnu::always_inline]] Crossings<S> crossed(const V3<S>& direction,
                                              const typename S::M& starts_here) const {
    const V3<S> p = cross<S>(direction, edge2_);
    const F determinant = dot<S>(edge1_, p);
    const auto crosses = S::abs(determinant) > F(detail::kLeastDeterminant);
    const F inverse = F(1.0f) / S::select(crosses, determinant, F(1.0f));
    const F overlap = S::min(overlap_ * S::abs(inverse), F(detail::kMaxOverlap));
    Crossings<S> c;
    c.u = dot<S>(from_v0_, p) * inverse;
    c.v = dot<S>(direction, q_) * inverse;
    c.near = distance_ * inverse;
    c.far = c.near;
    c.near_hit = crosses & (S::min(c.u, c.v) >= -overlap) & (c.u + c.v <= F(1.0f) + overlap) & !starts_here;
    c.far_hit = S::M::none();
    return c;
  }

  /// By the rays of a packet.
  [[gnu::always_inline]] Crossings<S> crossed(const RayPacket& rays, uint32_t self) const {
    return crossed(rays.direction.template load<S>(), lanes_that_start_on<S>(rays, self));
  }

private:
  V3<S> edge1_, edge2_, from_v0_, q_;
  F distance_, overlap_; ///< both times the determinant
};

template <class S>
Crossings<S> intersect_triangle(const V3<S>& origin, const V3<S>& direction, const typename S::M& starts_here,
                                const ObjectRecord& object) {
  return SeenTriangle<S>(origin, TriangleSides<S>::of(object)).crossed(direction, starts_here);
}

/// `self` is the object's offset in the scene image, against which the packet's start objects are compared.
template <class S> Crossings<S> intersect(const RayPacket& rays, const ObjectRecord& object, uint32_t self) {
  const V3<S> origin = rays.origin.template load<S>();
  const V3<S> direction = rays.direction.template load<S>();
  const auto starts_here = lanes_that_start_on<S>(rays, self);
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
