// Tests of triangles as occluders of a light: which points lie in their shadow volumes. Kernel dialect.
#pragma once

#include "kernel/direct/bundle_view.hpp"
#include "kernel/direct/leaf_triangles.hpp"

namespace celltrace::kernel {

/// The shadow volume of one triangle in each lane: the space behind the triangle, as seen from a light,
/// between the planes through the light and an edge. Tests take one triangle and the shadow rays of a packet
/// in lanes. A ray crosses the triangle on its way to the light if it starts in the volume, so that its
/// direction is not needed.
///
/// The scalar products of an origin and the normals of the planes, divided by their sum, are the barycentric
/// coordinates of the crossing. The crossing's distance relative to the ray's length is the origin's distance
/// from the triangle's plane divided by the sum of the distances of origin and light.
template <class S> class ShadowVolumes {
public:
  using F = typename S::F;
  using M = typename S::M;

  [[gnu::always_inline]] ShadowVolumes(const TriangleSides<S>& sides, const ShadowOrigins& origins) {
    const V3<S> corner = sides.v0 - splat3<S>(origins.base);
    const V3<S> to_light = splat3<S>(origins.light) - sides.v0;
    const V3<S> whole = cross<S>(sides.edge2, sides.edge1);
    // The planes are oriented so that all products are positive inside.
    const F whole_distance = dot<S>(whole, to_light);
    const F sign = S::select(whole_distance < F(0.0f), F(-1.0f), F(1.0f));
    set(0, cross<S>(to_light, sides.edge2) * sign, corner);
    set(1, cross<S>(sides.edge1, to_light) * sign, corner);
    set(2, whole * -sign, corner);
    (whole_distance * sign).store(light_.lane);
    // Neighbours overlap by the rounding of products, so that no ray passes between them (see TriangleTest).
    const F size = S::max(absolute_sum<S>(sides.edge1), absolute_sum<S>(sides.edge2));
    const F reach = (absolute_sum<S>(corner) + F(origins.span)) * size;
    (reach * absolute_sum<S>(to_light) * F(detail::kUnitInLastPlace)).store(overlap_.lane);
  }

  /// Returns the rays of a packet that triangle `i` occludes.
  [[gnu::always_inline]] M crossed(uint32_t i, const ShadowOrigins& origins, uint32_t packet) const {
    const V3<S> from = origins.origin[packet].template load<S>();
    const F u = product(0, i, from), v = product(1, i, from), distance = product(2, i, from);
    const F sum = distance + F(light_.lane[i]);
    const F overlap = S::min(F(overlap_.lane[i]), sum * F(detail::kMaxOverlap));
    return (S::min(S::min(u, v), sum - u - v) >= -overlap) &
           (distance > sum * F::load(origins.low[packet].lane)) &
           (distance < sum * F::load(origins.high[packet].lane));
  }

private:
  void set(uint32_t plane, const V3<S>& normal, const V3<S>& point) {
    normal_[plane].template store<S>(normal);
    dot<S>(normal, point).store(offset_[plane].lane);
  }
  F product(uint32_t plane, uint32_t i, const V3<S>& point) const {
    return kernel::product<S>(normal_[plane], i, point) - F(offset_[plane].lane[i]);
  }

  // Each lane has a triangle.
  VectorLanes normal_[3]; ///< normals of the planes through two of the edges, and of the triangle's plane
  FloatLanes offset_[3];  ///< normal * point, by plane
  FloatLanes light_;      ///< the light's distance from the triangle's plane, times the normal's length
  FloatLanes overlap_;    ///< epsilon of the products
};

} // namespace celltrace::kernel
