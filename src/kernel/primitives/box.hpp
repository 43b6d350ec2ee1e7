// The box: from -1 to 1 on each axis of its space. Kernel dialect.
#pragma once

#include "kernel/primitives/local_shape.hpp"

namespace celltrace::kernel {

struct BoxPrimitive : LocalPrimitive<BoxPrimitive> {
  static constexpr const char* kName = "box";
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasParameters = false;
  static constexpr bool kHasFaces = true;
  static constexpr bool kHasCoordinates = true;

  /// Returns the interval of rays inside the box by the slab test (Kay and Kajiya 1986). Rays that miss the
  /// box leave it before they enter it.
  template <class S>
  [[gnu::always_inline]] static SlabInterval<S> slabs_along(const V3<S>& o, const V3<S>& d) {
    using F = typename S::F;
    const F low(-1.0f), high(1.0f);
    const SlabInterval<S> x(o.x, d.x, low, high), y(o.y, d.y, low, high), z(o.z, d.z, low, high);
    return {S::max(S::max(x.enter, y.enter), z.enter), S::min(S::min(x.leave, y.leave), z.leave)};
  }

  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>& parameters,
                              Crossings<S>* crossings) {
    const SlabInterval<S> inside = slabs_along<S>(rays.origin, rays.direction);
    Crossings<S>& c = *crossings;
    c.clear();
    c.near = inside.enter;
    c.far = inside.leave;
    c.near_hit = c.far_hit = c.near <= c.far;
    drop_start<BoxPrimitive, S>(rays, parameters, c);
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>&) {
    using F = typename S::F;
    return S::max(S::max(S::abs(p.x), S::abs(p.y)), S::abs(p.z)) < F(1.0f);
  }

  /// Returns the normal of the face whose plane is nearest in the world: in the box's own space, the error of
  /// a point across a thin box is larger than its distance from the narrow sides. `ratio` and `second` are
  /// the excess of the lengths along x and y over the length along z, relative to the latter; 0 where it does
  /// not matter.
  template <class S>
  [[gnu::always_inline]] static V3<S> gradient(const V3<S>& p, const LocalParameters<S>& parameters) {
    using F = typename S::F;
    const F one(1.0f), zero(0.0f);
    const F in_x = one - S::abs(p.x), in_y = one - S::abs(p.y), z = one - S::abs(p.z);
    const F x = in_x + in_x * parameters.ratio, y = in_y + in_y * parameters.second;
    const auto is_x = (x <= y) & (x <= z);
    const auto is_y = (y <= z) & !is_x;
    // Across a very thin box, rounding may make the coordinate 0, which would be no normal. The coordinate is
    // then a multiple of a power of two that is too large for the sum to become 0.
    const F shift(0.298828125f);
    return {S::select(is_x, p.x + shift, zero), S::select(is_y, p.y + shift, zero),
            S::select(is_x | is_y, zero, p.z + shift)};
  }

  /// Maps the unfolded cube from -1 to 1: four sides around it in a row, and one above and one below the
  /// second of them.
  template <class S>
  [[gnu::always_inline]] static void coordinates(const SurfacePoint<S>& at, typename S::F& u,
                                                 typename S::F& v) {
    using F = typename S::F;
    const V3<S> p = to_local<S>(at.object.geometry, at.point, 1.0f);
    const V3<S> side = gradient<S>(p, LocalParameters<S>{F(0.0f), F(0.0f), S::M::none()});
    const F half(0.5f), zero(0.0f), one(1.0f);
    const F x = (p.x + one) * half, y = (p.y + one) * half, z = (p.z + one) * half;
    const auto is_x = !(side.x == zero), is_y = !(side.y == zero);
    F across = S::select(side.z < zero, F(4.0f) - x, one + x);
    across = S::select(is_x, S::select(side.x < zero, z, F(3.0f) - z), across);
    u = S::select(is_y, one + x, across) * F(0.25f);
    v = S::select(is_y, S::select(side.y < zero, z, F(3.0f) - z), one + y) * F(1.0f / 3);
  }

  /// Returns the distance of a point from its face. If a ray's path is more than a million times the box's
  /// thickness, the path does not tell two faces apart: the ray has hit the nearer face.
  template <class S>
  [[gnu::always_inline]] static typename S::F off_face(const V3<S>& p, const V3<S>& gradient,
                                                       const V3<S>& path) {
    using F = typename S::F;
    const auto off = [](const F& at, const F& along) {
      const F which = S::select(S::abs(along) > F(1e6f), -along, at);
      return at - S::select(which < F(0.0f), F(-1.0f), F(1.0f));
    };
    return dot<S>(gradient, {off(p.x, path.x), off(p.y, path.y), off(p.z, path.z)});
  }

  template <class S>
  [[gnu::always_inline]] static V3<S> off_parallel_faces(const V3<S>& p, const V3<S>& path, float share) {
    return {off_parallel_plane<S>(p.x, path.x, 0.0f, share), off_parallel_plane<S>(p.y, path.y, 0.0f, share),
            off_parallel_plane<S>(p.z, path.z, 0.0f, share)};
  }

  static LocalBounds local_bounds(float) { return {-1.0f, 1.0f, 1.0f, true}; }
};

} // namespace celltrace::kernel
