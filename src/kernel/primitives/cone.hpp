// The cone: x^2 + y^2 = r^2 in its space, where the radius r grows from `ratio` (the smaller radius over the
// larger one) at z = 0 to 1 at z = 1, by `second`; with or without caps. Kernel dialect.
#pragma once

#include "kernel/primitives/local_shape.hpp"

namespace celltrace::kernel {

struct ConePrimitive : LocalPrimitive<ConePrimitive> {
  static constexpr const char* kName = "cone";
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasParameters = true;
  static constexpr bool kHasFaces = true;

  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>& parameters,
                              Crossings<S>* crossings) {
    using F = typename S::F;
    const V3<S>& d = rays.direction;
    const F zero(0.0f), one(1.0f);
    // The equation starts from the point of the ray that is nearest to the middle, so that little cancels.
    const F length_square = S::max(dot<S>(d, d), F(1e-30f));
    const V3<S> from_middle = {rays.origin.x, rays.origin.y, rays.origin.z - F(0.5f)};
    const F shift = -dot<S>(from_middle, d) / length_square;
    const V3<S> o = rays.origin + d * shift;
    const F radius = radius_at<S>(o.z, parameters), growth = d.z * parameters.second;
    const F a = d.x * d.x + d.y * d.y - growth * growth;
    const F b = o.x * d.x + o.y * d.y - radius * growth;
    const F k = o.x * o.x + o.y * o.y - radius * radius;
    const F square = b * b - a * k;
    // If a < 0 there is always a crossing, at the apex at least; a negative square is rounding.
    const auto steep = a < zero;
    const auto crosses = (square >= zero) | steep;
    Crossings<S>& c = *crossings;
    c.clear();
    if (crosses.bits() == 0) return;
    const F root = S::sqrt(S::max(square, zero));
    const F q = -(b + S::select(b < zero, -root, root));
    const F first = q * finite_inverse<S>(a), second = k * finite_inverse<S>(q);
    const F low = S::min(first, second), high = S::max(first, second);
    // The inside is between the crossings or, for a steep ray, beyond the crossing of the nappe where r > 0.
    const F far_away(1e20f);
    const auto upward = d.z > zero;
    const F enter = S::select(steep, S::select(upward, high, -far_away), low);
    const F leave = S::select(steep, S::select(upward, far_away, low), high);
    const SlabInterval<S> caps(o.z, d.z, zero, one);
    const F near = S::select(parameters.open, low, S::max(enter, caps.enter));
    const F far = S::select(parameters.open, high, S::min(leave, caps.leave));
    const auto solid = crosses & (near <= far);
    const auto between = [&](const F& t) { return crosses & (t >= caps.enter) & (t <= caps.leave); };
    c.near_hit = (parameters.open & between(low)) | (solid & !parameters.open);
    c.far_hit = (parameters.open & between(high)) | (solid & !parameters.open);
    c.near = near + shift;
    c.far = far + shift;
    drop_start<ConePrimitive, S>(rays, parameters, c);
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>& parameters) {
    using F = typename S::F;
    const F radius = radius_at<S>(p.z, parameters);
    return (p.x * p.x + p.y * p.y < radius * radius) & (p.z > F(0.0f)) & (p.z < F(1.0f));
  }

  template <class S>
  [[gnu::always_inline]] static V3<S> gradient(const V3<S>& p, const LocalParameters<S>& parameters) {
    using F = typename S::F;
    const F zero(0.0f), one(1.0f);
    const F radius = radius_at<S>(p.z, parameters);
    const F from_side = S::abs(radius - S::sqrt(p.x * p.x + p.y * p.y));
    const F from_bottom = S::abs(p.z), from_top = S::abs(one - p.z);
    const auto cap = (S::min(from_bottom, from_top) < from_side) & !parameters.open;
    const F up = S::select(from_top < from_bottom, one, -one);
    return {S::select(cap, zero, p.x), S::select(cap, zero, p.y),
            S::select(cap, up, -radius * parameters.second)};
  }

  template <class S>
  [[gnu::always_inline]] static typename S::F off_face(const V3<S>& p, const V3<S>& gradient, const V3<S>&) {
    using F = typename S::F;
    const F zero(0.0f);
    const auto cap = (gradient.x == zero) & (gradient.y == zero);
    return S::select(cap, gradient.z * (p.z - S::max(gradient.z, zero)), zero);
  }

  static LocalBounds local_bounds(float) { return {0.0f, 1.0f, 1.0f, false}; }

private:
  template <class S>
  [[gnu::always_inline]] static typename S::F radius_at(const typename S::F& z,
                                                        const LocalParameters<S>& parameters) {
    return parameters.ratio + z * parameters.second;
  }
};

} // namespace celltrace::kernel
