// The polygon: in the plane z = 0 of its space, within the square from -1 to 1. Its own test finds the
// crossings with the square; module_polygons removes those outside the polygon. A polygon has no inside.
// Kernel dialect.
#pragma once

#include "kernel/primitives/local_shape.hpp"

#include <string.h>

namespace celltrace::kernel {

struct PolygonPrimitive : LocalPrimitive<PolygonPrimitive> {
  static constexpr const char* kName = "polygon";
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasParameters = true;
  static constexpr bool kHasFaces = true;
  static constexpr bool kHasEdges = true;

  /// Finds the crossings, and stores their x and y in u and v.
  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>&, Crossings<S>* crossings) {
    using F = typename S::F;
    Crossings<S>& c = *crossings;
    c.clear();
    c.near = -rays.origin.z * finite_inverse<S>(rays.direction.z);
    c.u = rays.origin.x + rays.direction.x * c.near;
    c.v = rays.origin.y + rays.direction.y * c.near;
    c.near_hit = (S::abs(rays.direction.z) > F(1e-10f)) & (S::abs(c.u) <= F(1.0f)) &
                 (S::abs(c.v) <= F(1.0f)) & !rays.starts_here;
  }

  template <class S> static typename S::M inside_local(const V3<S>&, const LocalParameters<S>&) {
    return S::M::none();
  }

  template <class S> [[gnu::always_inline]] static V3<S> gradient(const V3<S>&, const LocalParameters<S>&) {
    using F = typename S::F;
    return {F(0.0f), F(0.0f), F(1.0f)};
  }

  template <class S>
  [[gnu::always_inline]] static typename S::F off_face(const V3<S>& p, const V3<S>&, const V3<S>&) {
    return p.z;
  }

  static LocalBounds local_bounds(float) { return {0.0f, 0.0f, 1.0f, true}; }
};

/// Data in a polygon's ExtraRecord in place of its second and third value.
struct PolygonEdges {
  uint32_t first; ///< offset of a PolygonEdgeRecord
  uint32_t count;

  static PolygonEdges of(const ExtraRecord& extra) {
    PolygonEdges edges;
    memcpy(&edges, extra.value + 1, sizeof edges);
    return edges;
  }
  void put_in(ExtraRecord& extra) const { memcpy(extra.value + 1, this, sizeof *this); }
};

} // namespace celltrace::kernel
