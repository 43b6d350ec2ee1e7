// The polygon: in the plane z = 0 of its space, within the square from -1 to 1. Its own test finds the
// crossings with the square; module_polygons removes crossings outside the polygon. A polygon has no inside.
// Kernel dialect.
#pragma once

#include "kernel/primitives/flat_shape.hpp"

namespace celltrace::kernel {

struct PolygonPrimitive : FlatPrimitive<PolygonPrimitive> {
  static constexpr const char* kName = "polygon";
  static constexpr bool kHasParameters = true;
  static constexpr bool kHasData = true;
  static constexpr bool kHasEdges = true;

  /// Finds the crossings, and stores their x and y in u and v.
  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>&, Crossings<S>* crossings) {
    using F = typename S::F;
    Crossings<S>& c = *crossings;
    const auto crosses = cross_plane<S>(rays, c, c.u, c.v);
    c.near_hit = crosses & (S::abs(c.u) <= F(1.0f)) & (S::abs(c.v) <= F(1.0f));
  }

  template <class S> static typename S::M inside_local(const V3<S>&, const LocalParameters<S>&) {
    return S::M::none();
  }

  static LocalBounds local_bounds(float) { return {0.0f, 0.0f, 1.0f, true}; }
};

/// An edge of a polygon, in the plane of the polygon's space, from its lower end up: the numbers of a
/// ShapeDataRecord. The edge is beside a point at height y if low <= y < high; its column is `column` at `low`
/// and increases by `slope` per unit of height.
struct PolygonEdge {
  float low, high, column, slope;

  explicit PolygonEdge(const ShapeDataRecord& r)
      : low(r.value[0]), high(r.value[1]), column(r.value[2]), slope(r.value[3]) {}
};

} // namespace celltrace::kernel
