// Culling of a bundle's packets for triangles, by separating axes in the view of the bundle. Kernel dialect.
//
// In the map of a BundleView, a ray hits a triangle if its direction is on the inner side of the three planes
// through the origin and an edge. The edge functions are the scalar products of the direction and the planes'
// normals. Packets beside a corner are culled by the rectangle around the triangle.
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
    // The planes are oriented so that edge functions are positive for rays that hit the triangle in front of
    // the origin.
    const F sign = S::select(dot<S>(edge2, q) < F(0.0f), F(-1.0f), F(1.0f));
    const V3<S> u = p * sign, v = q * sign, w = whole * sign - u - v;
    inward_[0].template store<S>(u);
    inward_[1].template store<S>(v);
    inward_[2].template store<S>(w);
    // The margin is larger than the overlap of neighbours (see TriangleTest), so that no packet with a ray
    // that would hit is culled.
    const F size = S::max(absolute_sum<S>(edge1), absolute_sum<S>(edge2));
    const F uncertainty = (absolute_sum<S>(from) + F(view.span)) * F(32.0f * detail::kUnitInLastPlace);
    const F rounding = uncertainty * size;
    (-u.z - rounding).store(least_[0].lane);
    (-v.z - rounding).store(least_[1].lane);
    (-w.z - rounding).store(least_[2].lane);
    bound(from, edge1, edge2, uncertainty + size * F(4.0f * detail::kMaxOverlap));
  }

  /// Returns the packets that may hit triangle `i`: those whose rectangles reach the inner side of each plane
  /// and the triangle's rectangle.
  [[gnu::always_inline]] uint32_t seen_by(uint32_t i, const BundleView<S>& view) const {
    M seen = M::all();
    for (uint32_t axis = 0; axis < 2; ++axis)
      seen = seen & (view.seen[axis].high >= F(low_[axis].lane[i])) &
             (view.seen[axis].low <= F(high_[axis].lane[i]));
    for (uint32_t side = 0; side < 3; ++side) {
      const F x(inward_[side].x.lane[i]), y(inward_[side].y.lane[i]);
      const F most = S::max(x * view.seen[0].low, x * view.seen[0].high) +
                     S::max(y * view.seen[1].low, y * view.seen[1].high);
      seen = seen & (most >= F(least_[side].lane[i]));
    }
    return seen.bits();
  }

private:
  /// Computes the rectangles around the triangles' projections. Each corner lies within `reach` of the
  /// nearest hits. Triangles that come too close to the plane of depth 0 have no bounds.
  [[gnu::always_inline]] void bound(const V3<S>& from, const V3<S>& edge1, const V3<S>& edge2,
                                    const F& reach) {
    const V3<S> corner = {-from.x, -from.y, -from.z};
    const V3<S> corner1 = corner + edge1, corner2 = corner + edge2;
    const M is_bounded = S::min(S::min(corner.z, corner1.z), corner2.z) > F(2.0f) * reach;
    const F inverse = F(1.0f) / corner.z, inverse1 = F(1.0f) / corner1.z, inverse2 = F(1.0f) / corner2.z;
    // Hits may be less deep than the corners by `reach`, which is up to half of the corners' depths.
    const F relative = F(2.0f) * reach * S::max(S::max(inverse, inverse1), inverse2);
    const F* const axes[2][3] = {{&corner.x, &corner1.x, &corner2.x}, {&corner.y, &corner1.y, &corner2.y}};
    for (uint32_t i = 0; i < 2; ++i) {
      const F a = *axes[i][0] * inverse, b = *axes[i][1] * inverse1, c = *axes[i][2] * inverse2;
      const F low = S::min(S::min(a, b), c), high = S::max(S::max(a, b), c);
      const F margin = relative * (F(1.0f) + S::max(S::abs(low), S::abs(high)));
      S::select(is_bounded, low - margin, F(-kUnbounded)).store(low_[i].lane);
      S::select(is_bounded, high + margin, F(kUnbounded)).store(high_[i].lane);
    }
  }

  static constexpr float kUnbounded = 3e38f;

  // Each lane has a triangle.
  VectorLanes inward_[3];       ///< normals of the planes through edges, inward
  FloatLanes low_[2], high_[2]; ///< rectangle of the projection, at depth 1
  FloatLanes least_[3];         ///< bound of n.x * x + n.y * y for a ray (x, y, 1) inside
};

} // namespace celltrace::kernel
