// The disc: radius 1 around the origin of its space in the plane z = 0, with a hole of radius `ratio`. The
// half-space z < 0 is inside, as in POV-Ray. Kernel dialect.
#pragma once

#include "kernel/primitives/flat_shape.hpp"

namespace celltrace::kernel {

struct DiscPrimitive : FlatPrimitive<DiscPrimitive> {
  static constexpr const char* kName = "disc";
  static constexpr bool kHasParameters = true;

  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>& parameters,
                              Crossings<S>* crossings) {
    using F = typename S::F;
    F x, y;
    const auto crosses = cross_plane<S>(rays, *crossings, x, y);
    const F square = x * x + y * y;
    crossings->near_hit = crosses & (square <= F(1.0f)) & (square >= parameters.ratio * parameters.ratio);
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>&) {
    return p.z < typename S::F(0.0f);
  }

  static LocalBounds local_bounds(float) { return {0.0f, 0.0f, 1.0f, false}; }
};

} // namespace celltrace::kernel
