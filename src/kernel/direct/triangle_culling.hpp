// Culls the packets of a bundle for triangles, by edge functions in the view of the bundle. Kernel dialect.
//
// In the map of a BundleView, a ray hits a triangle if its direction is on the inner side of the three planes
// through the origin and an edge. The edge functions are the scalar products of the direction and the planes'
// normals.
#pragma once

#include "kernel/direct/bundle_view.hpp"
#include "kernel/direct/leaf_triangles.hpp"

namespace celltrace::kernel {

/// One triangle in each lane. A test takes one triangle and the packets of the bundle in lanes.
template <class S> class TriangleCulling {
public:
  using F = typename S::F;
  using M = typename S::M;

  [[gnu::always_inline]] TriangleCulling(const TriangleSides<S>& sides, const BundleView<S>& view) {
    const V3<S> from = view.to_origin(sides.v0);
    const V3<S> edge1 = view.mapped(sides.edge1), edge2 = view.mapped(sides.edge2);
    const V3<S> p = cross<S>(edge2, from), q = cross<S>(from, edge1), whole = cross<S>(edge2, edge1);
    // Oriented so that edge functions of rays that hit the triangle in front of the origin are positive.
    const F sign = S::select(dot<S>(edge2, q) < F(0.0f), F(-1.0f), F(1.0f));
    const V3<S> u = p * sign, v = q * sign, w = whole * sign - u - v;
    inward_[0].template store<S>(u);
    inward_[1].template store<S>(v);
    inward_[2].template store<S>(w);
    // Larger than the overlap of neighbours (see SeenTriangle): no packet is culled whose rays would hit.
    const F size = S::max(absolute_sum<S>(edge1), absolute_sum<S>(edge2));
    const F rounding = (absolute_sum<S>(from) + F(view.span)) * size * F(32.0f * detail::kUnitInLastPlace);
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

private:
  // A lane for each triangle.
  VectorLanes inward_[3]; ///< normals of the planes through edges, inward
  FloatLanes least_[3];   ///< bound of n.x * x + n.y * y for a ray (x, y, 1) inside
};

} // namespace celltrace::kernel
