// The triangle: three vertices in the world. The minimum-storage test of Moeller and Trumbore (1997). Kernel
// dialect.
#pragma once

#include "kernel/aabb.hpp"
#include "kernel/primitives/crossings.hpp"
#include "kernel/primitives/shape_traits.hpp"
#include "kernel/scalar.hpp"
#include "records/object.hpp"

namespace celltrace::kernel {

namespace detail {

// Constants of all tests of triangles.
constexpr float kUnitInLastPlace = 6e-8f;
constexpr float kMaxOverlap = 1e-3f;        ///< largest overlap of neighbours, in barycentric coordinates
constexpr float kLeastDeterminant = 1e-30f; ///< rays parallel to the plane have less

} // namespace detail

/// A triangle for a packet of rays, or one triangle for each lane.
template <class S> struct TriangleSides {
  V3<S> v0, edge1, edge2;

  static TriangleSides of(const ObjectRecord& object) {
    const float* g = object.geometry;
    const V3<S> corner = splat3<S>(g);
    return {corner, splat3<S>(g + 3) - corner, splat3<S>(g + 6) - corner};
  }
};

/// Returns the overlap of neighbouring triangles, times the determinant. The overlap is the largest rounding
/// error of the barycentric coordinates, so that no ray slips between triangles: it grows with the distance
/// over the triangle's size, and as the ray becomes parallel to the triangle.
template <class S>
[[gnu::always_inline]] inline typename S::F triangle_overlap(const V3<S>& from_v0, const V3<S>& edge1,
                                                             const V3<S>& edge2) {
  using F = typename S::F;
  const F size = S::max(absolute_sum<S>(edge1), absolute_sum<S>(edge2));
  return absolute_sum<S>(from_v0) * (F(detail::kUnitInLastPlace) * size);
}

/// A triangle as seen from the origins of a packet's rays: the part of the test that packets of one origin
/// share.
template <class S> class TriangleTest {
public:
  using F = typename S::F;

  [[gnu::always_inline]] TriangleTest(const V3<S>& origin, const TriangleSides<S>& sides)
      : edge1_(sides.edge1), edge2_(sides.edge2) {
    from_v0_ = origin - sides.v0;
    q_ = cross<S>(from_v0_, edge1_);
    distance_ = dot<S>(edge2_, q_);
    overlap_ = triangle_overlap<S>(from_v0_, edge1_, edge2_);
  }

  /// Returns the crossings of rays with these directions.
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

  /// Returns the rays with these directions that cross the triangle between the distances `first` and `last`.
  /// All comparisons are multiplied by the determinant, so that nothing has to be divided by it.
  [[gnu::always_inline]] typename S::M crossed_between(const V3<S>& direction,
                                                       const typename S::M& starts_here, const F& first,
                                                       const F& last) const {
    using I = typename S::I;
    const V3<S> p = cross<S>(direction, edge2_);
    const F determinant = dot<S>(edge1_, p), size = S::abs(determinant);
    const I sign = S::bits_of(determinant) & I::splat(INT32_MIN);
    const auto times_sign = [&](const F& x) { return S::float_of(S::bits_of(x) ^ sign); };
    const F u = times_sign(dot<S>(from_v0_, p)), v = times_sign(dot<S>(direction, q_));
    const F distance = times_sign(distance_), overlap = S::min(overlap_, size * F(detail::kMaxOverlap));
    const auto inside = (S::min(u, v) >= -overlap) & (u + v <= size + overlap);
    const auto in_between = (distance > first * size) & (distance < last * size);
    return (size > F(detail::kLeastDeterminant)) & inside & in_between & !starts_here;
  }

  /// Returns the crossings of a packet's rays.
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
  return TriangleTest<S>(origin, TriangleSides<S>::of(object)).crossed(direction, starts_here);
}

/// Tests a triangle and a box by separating axes (Akenine-Moeller 2001). The candidate voxels already overlap
/// on the box's axes; the test is for the triangle's normal and the nine cross products of edges.
inline bool triangle_overlaps(const ObjectRecord& object, const Aabb& box) {
  float vertex[3][3];
  float half[3];
  for (int i = 0; i < 3; ++i) {
    const float centre = 0.5f * (box.min[i] + box.max[i]);
    half[i] = 0.5f * (box.max[i] - box.min[i]);
    for (int v = 0; v < 3; ++v)
      vertex[v][i] = object.geometry[v * 3 + i] - centre;
  }
  const auto separates = [&](float x, float y, float z) {
    const float reach = half[0] * magnitude(x) + half[1] * magnitude(y) + half[2] * magnitude(z);
    float low = 0.0f;
    float high = 0.0f;
    for (int v = 0; v < 3; ++v) {
      const float along = vertex[v][0] * x + vertex[v][1] * y + vertex[v][2] * z;
      low = v == 0 ? along : smaller(low, along);
      high = v == 0 ? along : larger(high, along);
    }
    const float slack = reach * 1e-4f;
    return low > reach + slack || high < -reach - slack;
  };
  float edge[3][3];
  for (int e = 0; e < 3; ++e)
    for (int i = 0; i < 3; ++i)
      edge[e][i] = vertex[(e + 1) % 3][i] - vertex[e][i];
  if (separates(edge[0][1] * edge[1][2] - edge[0][2] * edge[1][1],
                edge[0][2] * edge[1][0] - edge[0][0] * edge[1][2],
                edge[0][0] * edge[1][1] - edge[0][1] * edge[1][0]))
    return false;
  for (int e = 0; e < 3; ++e) {
    const float* d = edge[e];
    if (separates(0.0f, d[2], -d[1]) || separates(-d[2], 0.0f, d[0]) || separates(d[1], -d[0], 0.0f))
      return false;
  }
  return true;
}

struct TrianglePrimitive : ShapeTraits {
  static constexpr const char* kName = "triangle";
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasParameters = false;
  static constexpr bool kHasCoordinates = true;
  static constexpr bool kReadsExtraForCoordinates = true;

  template <class S>
  static void intersect(const RayPacket& rays, const ObjectRecord& object, const ExtraRecord&, uint32_t self,
                        Crossings<S>* crossings) {
    *crossings = intersect_triangle<S>(rays.origin.template load<S>(), rays.direction.template load<S>(),
                                       lanes_that_start_on<S>(rays, self), object);
  }

  /// Returns no lanes: a triangle alone has no inside, and meshes have an inside vector.
  template <class S> static typename S::M inside(const V3<S>&, const ObjectRecord&, const ExtraRecord&) {
    return S::M::none();
  }

  /// Interpolates the surface coordinates of the vertices.
  template <class S>
  [[gnu::always_inline]] static void coordinates(const SurfacePoint<S>& at, typename S::F& u,
                                                 typename S::F& v) {
    using F = typename S::F;
    u = v = F(0.0f);
    if (at.extra == nullptr) return;
    const float(&uv)[6] = at.extra->bounds;
    const F rest = F(1.0f) - at.hit_u - at.hit_v;
    u = F(uv[0]) * rest + F(uv[2]) * at.hit_u + F(uv[4]) * at.hit_v;
    v = F(uv[1]) * rest + F(uv[3]) * at.hit_u + F(uv[5]) * at.hit_v;
  }

  static Aabb bounds(const ObjectRecord& object, const ExtraRecord&) {
    const float* g = object.geometry;
    Aabb box;
    for (int i = 0; i < 3; ++i) {
      box.min[i] = smaller(g[i], smaller(g[3 + i], g[6 + i]));
      box.max[i] = larger(g[i], larger(g[3 + i], g[6 + i]));
    }
    return box;
  }
  static bool overlaps(const ObjectRecord& object, const ExtraRecord&, const Aabb& box) {
    return triangle_overlaps(object, box);
  }
};

} // namespace celltrace::kernel
