// Triangles tested by Pluecker coordinates: the permuted inner products of a ray and a triangle's edges are,
// divided by their sum, barycentric coordinates. Kernel dialect.
#pragma once

#include "kernel/direct/bundle_view.hpp"
#include "kernel/direct/leaf_triangles.hpp"

namespace celltrace::kernel {

/// One triangle in each lane. Tests take one triangle and the shadow rays of a packet in lanes.
template <class S> class PlueckerTriangles {
public:
  using F = typename S::F;
  using M = typename S::M;

  [[gnu::always_inline]] PlueckerTriangles(const TriangleSides<S>& sides, const BundleMoments& moments) {
    const V3<S> corner = sides.v0 - splat3<S>(moments.base);
    const V3<S> whole = cross<S>(sides.edge2, sides.edge1);
    // Oriented so that the products of rays that cross the triangle toward the light are positive.
    const F toward_light = dot<S>(whole, splat3<S>(moments.light) - sides.v0);
    const F sign = S::select(toward_light < F(0.0f), F(-1.0f), F(1.0f));
    const V3<S> edge1 = sides.edge1 * sign, edge2 = sides.edge2 * sign;
    first_.template store<S>(edge2);
    first_moment_.template store<S>(cross<S>(corner, edge2));
    second_.template store<S>({-edge1.x, -edge1.y, -edge1.z});
    second_moment_.template store<S>(cross<S>(edge1, corner));
    const V3<S> normal = whole * sign;
    normal_.template store<S>(normal);
    dot<S>(normal, corner).store(plane_.lane);
    const F size = S::max(absolute_sum<S>(sides.edge1), absolute_sum<S>(sides.edge2));
    // Neighbours overlap by the rounding of products, so that no ray passes between them (see SeenTriangle).
    ((absolute_sum<S>(corner) + F(moments.span)) * size * F(detail::kUnitInLastPlace)).store(overlap_.lane);
  }

  /// The rays of a packet that cross triangle `i` at a distance between `low` and `high`.
  [[gnu::always_inline]] M crossed_between(uint32_t i, const RayPacket& rays, const VectorLanes& moment,
                                           const BundleMoments& moments, const F& low, const F& high) const {
    const V3<S> d = rays.direction.template load<S>(), m = moment.template load<S>();
    const V3<S> from = rays.origin.template load<S>() - splat3<S>(moments.base);
    const F u = product<S>(first_, i, m) + product<S>(first_moment_, i, d);
    const F v = product<S>(second_, i, m) + product<S>(second_moment_, i, d);
    const F sum = product<S>(normal_, i, d);
    const F overlap = S::min(F(overlap_.lane[i]), sum * F(detail::kMaxOverlap));
    const F distance = F(plane_.lane[i]) - product<S>(normal_, i, from);
    return (S::min(S::min(u, v), sum - u - v) >= -overlap) & (sum > F(detail::kLeastDeterminant)) &
           (distance > low * sum) & (distance < high * sum);
  }

private:
  // A lane for each triangle.
  VectorLanes first_, first_moment_, second_, second_moment_; ///< two edges: direction, moment
  VectorLanes normal_;
  FloatLanes plane_, overlap_; ///< normal * corner; epsilon of the products
};

} // namespace celltrace::kernel
