// The disc: radius 1 around the origin of its space in the plane z = 0, with a hole of radius `ratio`. The
// half-space z < 0 is inside, as in POV-Ray. Kernel dialect.
#pragma once

#include "kernel/primitives/local_shape.hpp"

namespace celltrace::kernel {

struct DiscPrimitive : LocalPrimitive<DiscPrimitive> {
  static constexpr const char* kName = "disc";
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasParameters = true;
  static constexpr bool kHasFaces = true;

  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>& parameters,
                              Crossings<S>* crossings) {
    using F = typename S::F;
    Crossings<S>& c = *crossings;
    c.clear();
    c.near = -rays.origin.z * finite_inverse<S>(rays.direction.z);
    const F x = rays.origin.x + rays.direction.x * c.near, y = rays.origin.y + rays.direction.y * c.near;
    const F square = x * x + y * y;
    c.near_hit = (S::abs(rays.direction.z) > F(1e-10f)) & (square <= F(1.0f)) &
                 (square >= parameters.ratio * parameters.ratio) & !rays.starts_here;
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>&) {
    return p.z < typename S::F(0.0f);
  }

  template <class S> [[gnu::always_inline]] static V3<S> gradient(const V3<S>&, const LocalParameters<S>&) {
    using F = typename S::F;
    return {F(0.0f), F(0.0f), F(1.0f)};
  }

  template <class S>
  [[gnu::always_inline]] static typename S::F off_face(const V3<S>& p, const V3<S>&, const V3<S>&) {
    return p.z;
  }

  static LocalBounds local_bounds(float) { return {0.0f, 0.0f, 1.0f, false}; }
};

} // namespace celltrace::kernel
