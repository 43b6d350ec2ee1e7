// Tests of triangles against rays from one point. Kernel dialect.
#pragma once

#include "kernel/direct/leaf_triangles.hpp"

namespace celltrace::kernel {

/// One triangle in each lane, as seen from one point. A test takes one triangle and the rays of a packet in
/// lanes.
///
/// The test is that of TriangleTest, with results that are equal to the last bit: of two triangles at the
/// same distance the same one is hit, whichever test has found them. Only the signs of the determinant and of
/// its dividends are changed, once for all rays, so that the determinant of a hit is positive.
template <class S> class PinholeTriangles {
public:
  using F = typename S::F;
  using M = typename S::M;

  [[gnu::always_inline]] PinholeTriangles(const TriangleSides<S>& sides, const float (&point)[3]) {
    const V3<S> from_v0 = splat3<S>(point) - sides.v0;
    const V3<S> q = cross<S>(from_v0, sides.edge1);
    const F distance = dot<S>(sides.edge2, q);
    const F sign = S::select(distance < F(0.0f), F(-1.0f), F(1.0f));
    edge1_.template store<S>(sides.edge1);
    edge2_.template store<S>(sides.edge2 * sign);
    from_v0_.template store<S>(from_v0);
    q_.template store<S>(q * sign);
    (distance * sign).store(distance_.lane);
    triangle_overlap<S>(from_v0, sides.edge1, sides.edge2).store(overlap_.lane);
  }

  /// Returns the crossings of rays from the point with triangle `i` in front of it.
  [[gnu::always_inline]] Crossings<S> crossed(uint32_t i, const V3<S>& direction) const {
    const V3<S> p = cross<S>(direction, edge2_.template of<S>(i));
    const F determinant = product<S>(edge1_, i, p);
    const F inverse = F(1.0f) / S::max(determinant, F(detail::kLeastDeterminant));
    const F overlap = S::min(F(overlap_.lane[i]) * inverse, F(detail::kMaxOverlap));
    Crossings<S> c;
    c.u = product<S>(from_v0_, i, p) * inverse;
    c.v = dot<S>(direction, q_.template of<S>(i)) * inverse;
    c.near = F(distance_.lane[i]) * inverse;
    c.far = c.near;
    c.near_hit = (determinant > F(detail::kLeastDeterminant)) & (S::min(c.u, c.v) >= -overlap) &
                 (c.u + c.v <= F(1.0f) + overlap);
    c.far_hit = M::none();
    return c;
  }

private:
  // A lane for each triangle; see TriangleTest.
  VectorLanes edge1_, edge2_, from_v0_, q_;
  FloatLanes distance_, overlap_;
};

} // namespace celltrace::kernel
