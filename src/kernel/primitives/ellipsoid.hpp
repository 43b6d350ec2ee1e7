// The ellipsoid, an affinely transformed sphere: the unit sphere of its space. Kernel dialect.
#pragma once

#include "kernel/primitives/local_shape.hpp"
#include "kernel/primitives/sphere.hpp"

namespace celltrace::kernel {

struct EllipsoidPrimitive : LocalPrimitive<EllipsoidPrimitive> {
  static constexpr const char* kName = "ellipsoid";
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasParameters = false;
  static constexpr bool kHasCoordinates = true;

  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>&, Crossings<S>* crossings) {
    using F = typename S::F;
    const V3<S>&o = rays.origin, &d = rays.direction;
    const F inverse_square = F(1.0f) / S::max(dot<S>(d, d), F(1e-30f));
    const F along = -dot<S>(o, d) * inverse_square;
    const V3<S> nearest = o + d * along;
    *crossings =
        detail::chord<S>(along, (F(1.0f) - dot<S>(nearest, nearest)) * inverse_square, rays.starts_here);
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>&) {
    return dot<S>(p, p) < typename S::F(1.0f);
  }

  /// Returns the normal at the point of the sphere that is nearest to `p`: rounding may move the end of a
  /// long ray off the sphere.
  template <class S> [[gnu::always_inline]] static V3<S> gradient(const V3<S>& p, const LocalParameters<S>&) {
    return normalise<S>(p);
  }

  template <class S>
  [[gnu::always_inline]] static void coordinates(const SurfacePoint<S>& at, typename S::F& u,
                                                 typename S::F& v) {
    if ((at.object.kind_and_flags & object_flag::flat_map) != 0) return;
    map_sphere<S>(to_local<S>(at.object.geometry, at.point, 1.0f), u, v);
  }

  static LocalBounds local_bounds(float) { return {-1.0f, 1.0f, 1.0f, false}; }

  /// Returns bounds that are tighter than those of a box around the sphere: half the extent along an axis is
  /// the length of that row of the map from the unit sphere to the world.
  static Aabb bounds(const ObjectRecord& object, const ExtraRecord&) {
    return round_bounds_in_world(object.geometry);
  }
};

} // namespace celltrace::kernel
