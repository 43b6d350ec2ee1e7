// The torus: around the z axis of its space, major radius 1, minor radius `ratio`. Kernel dialect.
//
// Measured from the point of the ray that is nearest to the centre, the quartic has no cubic term. The three
// places where its slope is 0 divide the ray into intervals with at most one crossing, which is found by
// Newton's method between bounds: this tolerates the rounding of single precision, which closed formulas of
// quartics do not.
#pragma once

#include "kernel/angles.hpp"
#include "kernel/primitives/local_shape.hpp"

namespace celltrace::kernel {

struct TorusPrimitive : LocalPrimitive<TorusPrimitive> {
  static constexpr const char* kName = "torus";
  static constexpr uint32_t kCrossingPairs = 2;
  static constexpr bool kHasParameters = true;
  static constexpr bool kIsHeavy = true;
  static constexpr bool kHasCoordinates = true;
  static constexpr bool kHasShadowTest = true;

  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>& parameters,
                              Crossings<S>* crossings) {
    using F = typename S::F;
    const F zero(0.0f), one(1.0f);
    const auto near_enough = may_hit<S>(rays, parameters.ratio);
    if (near_enough.bits() == 0) {
      for (uint32_t pair = 0; pair < kCrossingPairs; ++pair)
        crossings[pair].clear();
      return;
    }
    const FromCentre<S> from_centre(rays);
    const Quartic<S> f(from_centre, parameters.ratio);
    const F end = f.end();
    F bounds[5] = {-end, zero, zero, zero, end};
    f.stationary_points(near_enough, bounds[1], bounds[2], bounds[3]);
    for (int i = 1; i < 4; ++i)
      bounds[i] = S::min(S::max(bounds[i], -end), end);
    // A ray that starts here leaves the torus next if it goes inward, and otherwise enters the torus next. A
    // crossing before that is the start itself.
    const auto inward =
        rays.starts_here.bits() != 0 ? go_inward<TorusPrimitive, S>(rays, parameters) : S::M::none();
    auto starts = rays.starts_here;
    F distance[4];
    typename S::M hit[4] = {S::M::none(), S::M::none(), S::M::none(), S::M::none()};
    auto active = near_enough; // rays that want further crossings
    F value = one;             // value at the current bound, which is outside at first
    F half_width = zero;
    for (int i = 0; i < 4; ++i) {
      const F next = f.at(bounds[i + 1]);
      // The two crossings about each minimum are close to those of a parabola.
      if (i % 2 == 0) half_width = f.half_width(bounds[i + 1], next);
      const F about = i % 2 == 0 ? bounds[i + 1] - half_width : bounds[i] + half_width;
      const auto falls = value > zero;
      const auto enters = falls & (next <= zero), leaves = (next > zero) & !falls;
      const auto crosses = active & (enters | leaves);
      distance[i] = zero;
      if (crosses.bits() != 0) {
        distance[i] = (f.root_between(bounds[i], bounds[i + 1], about, falls, crosses) + from_centre.shift) *
                      from_centre.inverse_scale;
        const auto first = (distance[i] > zero) & ((inward & leaves) | (enters & !inward));
        hit[i] = crosses & !(starts & !first);
        starts = starts & !hit[i];
        active = active & !(hit[i] & (distance[i] > F(rays.request->enough)));
      }
      value = next;
    }
    for (uint32_t pair = 0; pair < kCrossingPairs; ++pair) {
      Crossings<S>& c = crossings[pair];
      c.clear();
      c.near = distance[2 * pair];
      c.far = distance[2 * pair + 1];
      c.near_hit = hit[2 * pair];
      c.far_hit = hit[2 * pair + 1];
    }
  }

  /// Returns the rays of `wanted`, which may hit the torus, that cross it farther than
  /// `rays.request->enough`, nearer than their limit less kShadowEpsilon, and where `clipped` keeps crossings
  /// (nullptr: everywhere). None of them may start on the torus.
  template <class S>
  static typename S::M crossed(const typename S::M& wanted, const LocalRays<S>& rays,
                               const typename S::F& ratio, const ClippedRays* clipped) {
    using F = typename S::F;
    using Segment = typename Quartic<S>::Segment;
    if (wanted.bits() == 0) return wanted;
    const FromCentre<S> from_centre(rays);
    const Quartic<S> f(from_centre, ratio);
    const auto there = [&](const F& distance) { return from_centre.place_at(distance); };
    const F first = there(F(rays.request->enough));
    const F last = there(F::load(rays.request->limit->lane) - F(kShadowEpsilon));
    if (clipped == nullptr) return f.crosses(wanted, {Segment{first, last}});
    const F enter = there(F::load(clipped->enter.lane)), leave = there(F::load(clipped->leave.lane));
    if (clipped->keeps_inside) return f.crosses(wanted, {Segment{S::max(first, enter), S::min(last, leave)}});
    // For rays that miss the solid, both segments overlap.
    return f.crosses(wanted, {Segment{first, S::min(last, enter)}, Segment{S::max(first, leave), last}});
  }

  /// Returns some of the rays for which crossed() is true, at little cost: rays that are inside the torus
  /// where they cross its plane, and were outside before. Rays for which rounding might decide are left out.
  template <class S>
  static typename S::M surely_crossed(const LocalRays<S>& rays, const typename S::F& ratio,
                                      const ClippedRays* clipped) {
    using F = typename S::F;
    const V3<S>&o = rays.origin, &d = rays.direction;
    const F margin(1e-3f), one(1.0f), zero(0.0f);
    const F t = -o.z * finite_inverse<S>(d.z);
    const F first(rays.request->enough);
    F begin = first;
    auto counts = t < F::load(rays.request->limit->lane) - F(kShadowEpsilon);
    if (clipped != nullptr) {
      const F enter = F::load(clipped->enter.lane), leave = F::load(clipped->leave.lane);
      if (clipped->keeps_inside) {
        begin = S::max(first, enter);
        counts = counts & (t < leave);
      } else {
        const auto is_behind = t > leave;
        begin = S::select(is_behind, S::max(first, leave), first);
        counts = counts & (is_behind | (t < enter));
      }
    }
    counts = counts & (t > begin);
    const F x = o.x + d.x * t, y = o.y + d.y * t, square = x * x + y * y;
    const F hole = S::max(one - ratio + margin, zero), outer = one + ratio - margin;
    counts = counts & (square > hole * hole) & (square < outer * outer) & (outer > hole);
    const V3<S> p = o + d * begin;
    const F g = dot<S>(p, p) + one - ratio * ratio;
    return counts & (g * g * (one - margin) > F(4.0f) * (p.x * p.x + p.y * p.y));
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>& parameters) {
    using F = typename S::F;
    const F around = F(1.0f) - S::sqrt(p.x * p.x + p.y * p.y);
    return around * around + p.z * p.z < parameters.ratio * parameters.ratio;
  }

  template <class S> [[gnu::always_inline]] static V3<S> gradient(const V3<S>& p, const LocalParameters<S>&) {
    using F = typename S::F;
    // The normal points from the nearest point of the circle in the tube's middle.
    const F inverse = F(1.0f) / S::max(S::sqrt(p.x * p.x + p.y * p.y), F(1e-20f));
    return {p.x - p.x * inverse, p.y - p.y * inverse, p.z};
  }

  /// Returns all rays that hit the torus before their limits, and few others. Most rays that come near a
  /// torus miss it, many of them through its hole: this test takes one division or two, the quartic four
  /// roots and more divisions.
  template <class S> static typename S::M may_hit(const LocalRays<S>& rays, const typename S::F& ratio) {
    using F = typename S::F;
    const V3<S>&o = rays.origin, &d = rays.direction;
    const F zero(0.0f), one(1.0f);
    const F rounding = F(1e-4f) + absolute_sum<S>(o) * F(1e-6f);
    const F outer = one + ratio + rounding, height = ratio + rounding;
    const F ahead = dot<S>(o, d), outside = dot<S>(o, o) * F(1.0f - 1e-6f) - outer * outer;
    const auto in_ball = ahead * ahead >= dot<S>(d, d) * outside;
    const auto comes_near = (ahead <= zero) | (outside <= zero);
    // A ray through the hole does not leave the hole while it is as near to the plane as the tube.
    const SlabInterval<S> slab(o.z, d.z, -height, height);
    const auto from_axis = [&](const F& t) {
      const F x = o.x + d.x * t, y = o.y + d.y * t;
      return x * x + y * y;
    };
    const F hole = S::max(one - ratio - rounding, zero), hole_square = hole * hole;
    const auto in_hole = (from_axis(slab.enter) < hole_square) & (from_axis(slab.leave) < hole_square);
    const auto near_enough = in_ball & comes_near & (slab.leave >= zero) & !in_hole;
    if constexpr (S::kLanes != kSimdLanes) return near_enough; // there is no room for more code
    const FloatLanes* const limit = rays.request->limit;
    const auto in_time = limit != nullptr ? near_enough & (slab.enter <= F::load(limit->lane)) : near_enough;
    if (in_time.bits() == 0) return in_time;
    // The ray must also come near the tube there.
    const F nearest = -(o.x * d.x + o.y * d.y) / S::max(d.x * d.x + d.y * d.y, F(1e-30f));
    return in_time & (from_axis(S::min(S::max(nearest, slab.enter), slab.leave)) <= outer * outer);
  }

  /// Finds the coordinates around the ring and around the tube. The axes here are z, x, y of POV-Ray's.
  template <class S>
  [[gnu::always_inline]] static void coordinates(const SurfacePoint<S>& at, typename S::F& u,
                                                 typename S::F& v) {
    using F = typename S::F;
    const V3<S> p = to_local<S>(at.object.geometry, at.point, 1.0f);
    u = F(0.5f) - turns_inline<S>(p.x, p.y);
    v = F(0.5f) + turns_inline<S>(p.z, S::sqrt(p.x * p.x + p.y * p.y) - F(1.0f));
  }

  static LocalBounds local_bounds(float ratio) { return {-ratio, ratio, 1.0f + ratio, false}; }

private:
  /// Ratio below which tori are thin.
  static constexpr float kThin = 0.1f;
  /// Step below which Newton's method ends: the next step would be in the order of its square.
  static constexpr float kConverged = 1e-4f;
  /// Step below which Halley's method ends: the next step would be in the order of its cube.
  static constexpr float kStationary = 1e-3f;

  /// Rays measured from their nearest points to the centre, in units of the torus's space.
  template <class S> struct FromCentre {
    using F = typename S::F;
    F scale, inverse_scale, shift;
    V3<S> direction, origin;

    explicit FromCentre(const LocalRays<S>& rays) {
      scale = S::sqrt(S::max(dot<S>(rays.direction, rays.direction), F(1e-30f)));
      inverse_scale = F(1.0f) / scale;
      direction = rays.direction * inverse_scale;
      shift = -dot<S>(rays.origin, direction);
      origin = rays.origin + direction * shift;
    }
    /// Converts a distance along the ray.
    F place_at(const F& distance) const { return distance * scale - shift; }
  };

  /// The quartic t^4 + p t^2 + q t + r along a ray, which is the torus's function at the ray's points.
  template <class S> struct Quartic {
    using F = typename S::F;
    V3<S> origin, direction;
    F inner, outer, p, q, r; ///< `inner` and `outer` are radii of the torus
    typename S::M thin;      ///< lanes with thin tori

    Quartic(const FromCentre<S>& rays, const F& ratio) : origin(rays.origin), direction(rays.direction) {
      const V3<S>&o = origin, &d = direction;
      const F one(1.0f), two(2.0f), four(4.0f);
      const F g = dot<S>(o, o) + one - ratio * ratio;
      inner = one - ratio;
      outer = one + ratio;
      thin = ratio < F(kThin);
      p = two * g - four * (d.x * d.x + d.y * d.y);
      q = F(-8.0f) * (o.x * d.x + o.y * d.y);
      r = g * g - four * (o.x * o.x + o.y * o.y);
    }
    /// Returns a place slightly beyond the torus, which is certainly outside.
    F end() const {
      return S::sqrt(S::max(outer * outer - dot<S>(origin, origin), F(0.0f))) * F(1.001f) + F(1e-4f);
    }

    /// An interval in which a zero is searched for.
    struct Segment {
      F first, last;
    };
    /// Returns the rays of `wanted` with a zero in one of some segments: the sign changes at an end of a
    /// segment or at a place where the slope is 0.
    template <uint32_t kCount>
    typename S::M crosses(const typename S::M& wanted, const Segment (&segments)[kCount]) const {
      const F zero(0.0f);
      uint32_t nonempty[kCount], inside[kCount], crossed = 0, all = 0;
      for (uint32_t i = 0; i < kCount; ++i) {
        nonempty[i] = (wanted & (segments[i].first < segments[i].last)).bits();
        inside[i] = (at(segments[i].first) < zero).bits();
        crossed |= nonempty[i] & (inside[i] ^ (at(segments[i].last) < zero).bits());
        all |= nonempty[i];
      }
      const auto unknown = S::M::from_bits(all & ~crossed & 0xFFFF);
      if (unknown.bits() != 0) {
        F place[3];
        stationary_points(unknown, place[0], place[1], place[2]);
        for (uint32_t i = 0; i < kCount; ++i)
          for (const F& t : place) {
            const F in_segment = S::min(S::max(t, segments[i].first), segments[i].last);
            crossed |= nonempty[i] & (inside[i] ^ (at(in_segment) < zero).bits());
          }
      }
      return S::M::from_bits(crossed & 0xFFFF);
    }

    /// Returns the value. For a thin torus the value is computed from the point, as the square of a thin tube
    /// is lost in the difference r. Its first factor is for the tube on the axis's side of the point. If rays
    /// are processed in parts, for lack of room for code, all tori count as thin.
    F at(const F& t) const {
      if constexpr (S::kLanes == kSimdLanes) {
        const uint32_t thin_lanes = thin.bits() & 0xFFFF;
        if (thin_lanes == 0) return at_thick(t);
        if (thin_lanes != 0xFFFF) return S::select(thin, at_thin(t), at_thick(t));
      }
      return at_thin(t);
    }
    F at_thick(const F& t) const {
      const F square = t * t;
      return square * square + p * square + q * t + r;
    }
    F at_thin(const F& t) const {
      const F x = origin.x + direction.x * t, y = origin.y + direction.y * t, z = origin.z + direction.z * t;
      const F around = S::sqrt(x * x + y * y), square = z * z;
      return ((around - outer) * (around - inner) + square) * ((around + outer) * (around + inner) + square);
    }
    F slope(const F& t) const { return (F(4.0f) * t * t + F(2.0f) * p) * t + q; }

    /// Finds the places where the slope is 0 for the rays `wanted`, in rising order; all three are equal if
    /// there is only one.
    void stationary_points(typename S::M wanted, F& a, F& b, F& c) const {
      // x^3 + (p/2) x - |q|/4 is convex for x > 0 and has its greatest zero there: Halley's method descends
      // to it from any bound. No torus reaches farther than 2 from its centre.
      const F half(0.5f), zero(0.0f);
      const F linear = p * half, constant = S::abs(q) * F(0.25f);
      F x = S::min(F(2.5f), S::sqrt(S::max(-linear, zero)) + above_cube_root(constant));
      for (int i = 0; i < 9 && wanted.bits() != 0; ++i) {
        const F square = x * x;
        const F value = square * x + linear * x - constant;
        const F slope = S::max(F(3.0f) * square + linear, F(1e-6f));
        const F divisor = S::max(slope * slope - F(3.0f) * x * value, F(1e-12f));
        const F next = S::max(x - value * slope / divisor, zero);
        const auto moves = S::abs(next - x) > F(kStationary);
        x = S::select(wanted, next, x);
        wanted = wanted & moves;
      }
      const F greatest = S::select(q < zero, x, -x);
      // The other places are zeros of t^2 + greatest t + (greatest^2 + p/2).
      const F discriminant = F(-3.0f) * greatest * greatest - F(2.0f) * p;
      const auto three = discriminant > zero;
      const F root = S::sqrt(S::max(discriminant, zero));
      const F u = S::select(three, (-greatest - root) * half, greatest);
      const F v = S::select(three, (-greatest + root) * half, greatest);
      a = S::min(greatest, u);
      c = S::max(greatest, v);
      b = S::max(S::min(greatest, v), u);
    }

    /// Returns the cube root of x >= 0, or up to a tenth more: the bits are nearly the logarithm, which is
    /// divided by three.
    static F above_cube_root(const F& x) {
      using I = typename S::I;
      const F third = S::to_float(S::bits_of(x)) * F(1.0f / 3);
      return F(1.07f) * S::float_of(S::to_int(third) + I::splat(0x2A50'0000));
    }

    /// Returns the distance from `least` of the zeros of a parabola that has slope 0, the value `value` and
    /// the quartic's curvature there.
    F half_width(const F& least, const F& value) const {
      const F curvature = F(12.0f) * least * least + F(2.0f) * p;
      return S::sqrt(S::max(F(-2.0f) * value / S::max(curvature, F(1e-6f)), F(0.0f)));
    }

    /// Returns the zero between `low` and `high`, between which the slope has one sign, for the rays
    /// `wanted`; it is probably near `about`. `falls`: positive at `low`. The result of a ray depends on no
    /// other ray.
    F root_between(F low, F high, const F& about, const typename S::M& falls, typename S::M wanted) const {
      const F sign = S::select(falls, F(-1.0f), F(1.0f)), half(0.5f);
      F t = S::select((about >= low) & (about <= high), about, (low + high) * half);
      for (int i = 0; i < 10 && wanted.bits() != 0; ++i) {
        const F value = at(t) * sign;
        const auto root_is_above = value <= F(0.0f);
        low = S::select(root_is_above, t, low);
        high = S::select(root_is_above, high, t);
        const F newton = t - value / S::max(slope(t) * sign, F(1e-20f));
        const auto sane = (newton >= low) & (newton <= high);
        const F next = S::select(sane, newton, (low + high) * half);
        const auto moves = S::abs(next - t) > F(kConverged);
        t = S::select(wanted, next, t);
        wanted = wanted & moves;
      }
      return t;
    }
  };
};

} // namespace celltrace::kernel
