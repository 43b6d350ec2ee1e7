// The cylinder: radius 1 around the z axis of its space, from z = 0 to z = 1; with or without caps. Kernel
// dialect.
#pragma once

#include "kernel/primitives/local_shape.hpp"

namespace celltrace::kernel {

struct CylinderPrimitive : LocalPrimitive<CylinderPrimitive> {
  static constexpr const char* kName = "cylinder";
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasParameters = false;
  static constexpr bool kHasFaces = true;

  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>& parameters,
                              Crossings<S>* crossings) {
    using F = typename S::F;
    const V3<S>&o = rays.origin, &d = rays.direction;
    const F zero(0.0f), one(1.0f);
    // The infinite cylinder is intersected about the point of the ray that is nearest to the axis.
    const F square = d.x * d.x + d.y * d.y;
    const auto along_axis = square <= F(1e-14f) * (square + d.z * d.z);
    const F inverse = one / S::select(along_axis, one, square);
    const F middle = -(o.x * d.x + o.y * d.y) * inverse;
    const F x = o.x + d.x * S::select(along_axis, zero, middle);
    const F y = o.y + d.y * S::select(along_axis, zero, middle);
    const F left = one - (x * x + y * y);
    const auto crosses = left >= zero;
    Crossings<S>& c = *crossings;
    c.clear();
    if (crosses.bits() == 0) return;
    const F half = S::sqrt(S::max(left, zero) * inverse);
    const F far_away(1e20f);
    const F enter = S::select(along_axis, -far_away, middle - half);
    const F leave = S::select(along_axis, far_away, middle + half);
    const SlabInterval<S> caps(o.z, d.z, zero, one);
    c.near = S::select(parameters.open, enter, S::max(enter, caps.enter));
    c.far = S::select(parameters.open, leave, S::min(leave, caps.leave));
    const auto solid = crosses & (c.near <= c.far);
    const auto between = [&](const F& t) {
      return crosses & !along_axis & (t >= caps.enter) & (t <= caps.leave);
    };
    c.near_hit = (parameters.open & between(enter)) | (solid & !parameters.open);
    c.far_hit = (parameters.open & between(leave)) | (solid & !parameters.open);
    drop_start<CylinderPrimitive, S>(rays, parameters, c);
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>&) {
    using F = typename S::F;
    return (p.x * p.x + p.y * p.y < F(1.0f)) & (p.z > F(0.0f)) & (p.z < F(1.0f));
  }

  /// Returns the normal. `ratio` is the excess of the radius over the height, relative to the height, as for
  /// a box; 0 where it does not matter.
  template <class S>
  [[gnu::always_inline]] static V3<S> gradient(const V3<S>& p, const LocalParameters<S>& parameters) {
    using F = typename S::F;
    const F zero(0.0f), one(1.0f);
    const F in_radii = S::abs(one - S::sqrt(p.x * p.x + p.y * p.y));
    const F from_side = in_radii + in_radii * parameters.ratio;
    const F from_bottom = S::abs(p.z), from_top = S::abs(one - p.z);
    const auto cap = (S::min(from_bottom, from_top) < from_side) & !parameters.open;
    const F up = S::select(from_top < from_bottom, one, -one);
    return {S::select(cap, zero, p.x), S::select(cap, zero, p.y), S::select(cap, up, zero)};
  }

  template <class S>
  [[gnu::always_inline]] static typename S::F off_face(const V3<S>& p, const V3<S>& gradient, const V3<S>&) {
    return gradient.z * (p.z - S::max(gradient.z, typename S::F(0.0f)));
  }

  template <class S>
  [[gnu::always_inline]] static V3<S> off_parallel_faces(const V3<S>& p, const V3<S>& path, float share) {
    return {p.x, p.y, off_parallel_plane<S>(p.z, path.z, 0.5f, share)};
  }

  static LocalBounds local_bounds(float) { return {0.0f, 1.0f, 1.0f, false}; }
};

} // namespace celltrace::kernel
