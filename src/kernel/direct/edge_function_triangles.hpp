// Triangles tested by edge functions, in the view of a bundle. Kernel dialect.
//
// In the map of a BundleView, a ray hits a triangle if its direction is on the inner side of the three planes
// through the origin and an edge. The edge functions are the scalar products of the direction and the planes'
// normals. Divided by their sum, they are barycentric coordinates.
#pragma once

#include "kernel/direct/bundle_view.hpp"
#include "kernel/direct/leaf_triangles.hpp"

namespace celltrace::kernel {

/// One triangle in each lane. Tests take one triangle and packets, or rays, in lanes.
template <class S> class EdgeFunctionTriangles {
public:
  using F = typename S::F;
  using M = typename S::M;

  [[gnu::always_inline]] EdgeFunctionTriangles(const TriangleSides<S>& sides, const BundleView<S>& view) {
    const V3<S> from = view.to_origin(sides.v0);
    const V3<S> edge1 = view.mapped(sides.edge1), edge2 = view.mapped(sides.edge2);
    const V3<S> p = cross<S>(edge2, from), q = cross<S>(from, edge1), whole = cross<S>(edge2, edge1);
    // Oriented so that edge functions of rays that hit the triangle in front of the origin are positive.
    const F distance = dot<S>(edge2, q);
    const F sign = S::select(distance < F(0.0f), F(-1.0f), F(1.0f));
    (distance * sign).store(distance_.lane);
    const F size = S::max(absolute_sum<S>(edge1), absolute_sum<S>(edge2));
    const F reach = absolute_sum<S>(from);
    // Neighbours overlap by the rounding of edge functions, so that no ray passes between them (see
    // SeenTriangle).
    (reach * size * F(detail::kUnitInLastPlace)).store(overlap_.lane);
    const V3<S> u = p * sign, v = q * sign, all = whole * sign, w = all - u - v;
    whole_.template store<S>(all);
    inward_[0].template store<S>(u);
    inward_[1].template store<S>(v);
    inward_[2].template store<S>(w);
    // Epsilon of culling, larger than that overlap: it must not cull a packet whose rays would hit.
    const F rounding = (reach + F(view.span)) * size * F(32.0f * detail::kUnitInLastPlace);
    (-u.z - rounding).store(least_[0].lane);
    (-v.z - rounding).store(least_[1].lane);
    (-w.z - rounding).store(least_[2].lane);
  }

  /// Returns the packets that may hit triangle `i`: those whose rectangles reach the inner side of each
  /// plane.
  [[gnu::always_inline]] uint32_t seen_by(uint32_t i, const BundleView<S>& view) const {
    M seen = M::all();
    for (uint32_t side = 0; side < 3; ++side) {
      const F x(inward_[side].x.lane[i]), y(inward_[side].y.lane[i]);
      const F most = S::max(x * view.seen[0].low, x * view.seen[0].high) +
                     S::max(y * view.seen[1].low, y * view.seen[1].high);
      seen = seen & (most >= F(least_[side].lane[i]));
    }
    return seen.bits();
  }

  /// Where rays from the origin, with mapped directions, cross triangle `i`.
  [[gnu::always_inline]] Crossings<S> crossed(uint32_t i, const V3<S>& direction) const {
    const F u = product<S>(inward_[0], i, direction), v = product<S>(inward_[1], i, direction);
    const F sum = product<S>(whole_, i, direction);
    const F overlap = S::min(F(overlap_.lane[i]), sum * F(detail::kMaxOverlap));
    const F inverse = F(1.0f) / S::max(sum, F(detail::kLeastDeterminant));
    Crossings<S> c;
    c.u = u * inverse;
    c.v = v * inverse;
    c.near = F(distance_.lane[i]) * inverse;
    c.far = c.near;
    c.near_hit = (S::min(S::min(u, v), sum - u - v) >= -overlap) & (sum > F(detail::kLeastDeterminant));
    c.far_hit = M::none();
    return c;
  }

private:
  // A lane for each triangle.
  VectorLanes inward_[3];         ///< normals of the planes through edges, inward
  VectorLanes whole_;             ///< their sum
  FloatLanes least_[3];           ///< bound of n.x * x + n.y * y for a ray (x, y, 1) inside
  FloatLanes distance_, overlap_; ///< distance and epsilon, times the sum of the edge functions
};

} // namespace celltrace::kernel
