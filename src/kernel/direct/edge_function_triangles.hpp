// The triangles of a leaf as the packets of a bundle see them. Kernel dialect.
//
// In the map of a BundleView, a triangle is what lies between three planes through the origin and its sides:
// a ray meets it if it is on the inner side of all three. The products of the ray's direction and the planes'
// normals are its barycentric coordinates, but for their sum.
#pragma once

#include "kernel/direct/bundle_view.hpp"
#include "kernel/direct/leaf_triangles.hpp"

namespace celltrace::kernel {

template <class S> class EdgeFunctionTriangles {
public:
  using F = typename S::F;
  using M = typename S::M;

  [[gnu::always_inline]] EdgeFunctionTriangles(const TriangleSides<S>& sides, const BundleView<S>& view) {
    const V3<S> from = view.to_origin(sides.v0);
    const V3<S> edge1 = view.mapped(sides.edge1), edge2 = view.mapped(sides.edge2);
    const V3<S> p = cross<S>(edge2, from), q = cross<S>(from, edge1), whole = cross<S>(edge2, edge1);
    // Turned so that rays that meet them in front of the origin have positive products.
    const F distance = dot<S>(edge2, q);
    const F sign = S::select(distance < F(0.0f), F(-1.0f), F(1.0f));
    (distance * sign).store(distance_.lane);
    const F size = S::max(absolute_sum<S>(edge1), absolute_sum<S>(edge2));
    const F reach = absolute_sum<S>(from);
    (reach * size * F(detail::kUnitInLastPlace)).store(overlap_.lane);
    const V3<S> u = p * sign, v = q * sign, all = whole * sign, w = all - u - v;
    whole_.template store<S>(all);
    inward_[0].template store<S>(u);
    inward_[1].template store<S>(v);
    inward_[2].template store<S>(w);
    const F rounding = (reach + F(view.span)) * size * F(32.0f * detail::kUnitInLastPlace);
    (-u.z - rounding).store(least_[0].lane);
    (-v.z - rounding).store(least_[1].lane);
    (-w.z - rounding).store(least_[2].lane);
  }

  /// Which packets may meet triangle `i`.
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

  /// Where rays from the origin cross triangle `i`. Directions are mapped.
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
  VectorLanes inward_[3];         ///< normals of the planes through the sides
  VectorLanes whole_;             ///< their sum
  FloatLanes least_[3];           ///< what the first two coordinates add to the product of a ray inside
  FloatLanes distance_, overlap_; ///< both times the sum of the products
};

} // namespace celltrace::kernel
