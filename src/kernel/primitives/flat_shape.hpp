// Flat shapes in the plane z = 0 of their space. Kernel dialect.
#pragma once

#include "kernel/primitives/local_shape.hpp"

namespace celltrace::kernel {

template <class Shape> struct FlatPrimitive : LocalPrimitive<Shape> {
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasFaces = true;

  /// Sets the rays' crossings with the plane, of which none counts yet, and their x and y in the plane.
  /// Returns the rays that may hit the shape: rays in its plane and rays that start on the shape do not.
  template <class S>
  [[gnu::always_inline]] static typename S::M cross_plane(const LocalRays<S>& rays, Crossings<S>& c,
                                                          typename S::F& x, typename S::F& y) {
    c.clear();
    c.near = -rays.origin.z * finite_inverse<S>(rays.direction.z);
    x = rays.origin.x + rays.direction.x * c.near;
    y = rays.origin.y + rays.direction.y * c.near;
    return (S::abs(rays.direction.z) > typename S::F(1e-10f)) & !rays.starts_here;
  }

  template <class S> [[gnu::always_inline]] static V3<S> gradient(const V3<S>&, const LocalParameters<S>&) {
    using F = typename S::F;
    return {F(0.0f), F(0.0f), F(1.0f)};
  }

  template <class S>
  [[gnu::always_inline]] static typename S::F off_face(const V3<S>& p, const V3<S>&, const V3<S>&) {
    return p.z;
  }
};

} // namespace celltrace::kernel
