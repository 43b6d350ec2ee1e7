// Superellipsoid: (|x|^p + |y|^p)^(q/p) + |z|^q = 1 of its space, where p is `ratio` and q is `second`.
// Kernel dialect.
//
// Rays are followed by the sum's root, to the power 1/q: as a distance does, it grows in proportion to how
// far a point is from the centre, so that single precision does for any exponents. Where p and q are 1 or
// more it is convex, and the line has one interval inside. Otherwise the shape is thin along the planes
// between the octants; these part the line into intervals, in each of which the root turns once at most.
#pragma once

#include "kernel/primitives/local_shape.hpp"

namespace celltrace::kernel {

struct SuperellipsoidPrimitive : LocalPrimitive<SuperellipsoidPrimitive> {
  static constexpr const char* kName = "superellipsoid";
  static constexpr uint32_t kCrossingPairs = 2;
  static constexpr bool kHasParameters = true;
  static constexpr bool kIsHeavy = true;

  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>& parameters,
                              Crossings<S>* crossings) {
    using F = typename S::F;
    using M = typename S::M;
    const F zero(0.0f), one(1.0f);
    for (uint32_t pair = 0; pair < kCrossingPairs; ++pair)
      crossings[pair].clear();
    const F inverse_scale = one / S::sqrt(S::max(dot<S>(rays.direction, rays.direction), F(1e-30f)));
    Profile<S> f;
    f.parameters = parameters;
    f.d = rays.direction * inverse_scale;
    const F shift = -dot<S>(rays.origin, f.d);
    f.o = rays.origin + f.d * shift;
    // Where the line crosses the planes between octants, and where it is in the box: a little more of it, so
    // that it is outside at both ends for certain.
    const V3<S> inverse = {finite_inverse<S>(f.d.x), finite_inverse<S>(f.d.y), finite_inverse<S>(f.d.z)};
    const F reach(1.001f);
    const F x = -f.o.x * inverse.x, y = -f.o.y * inverse.y, z = -f.o.z * inverse.z;
    const V3<S> half = {S::abs(inverse.x) * reach, S::abs(inverse.y) * reach, S::abs(inverse.z) * reach};
    const F enter = max_component<S>({x - half.x, y - half.y, z - half.z});
    const F leave = S::min(x + half.x, S::min(y + half.y, z + half.z));
    const M in_box = enter < leave;
    if (in_box.bits() == 0) return;
    f.convex = (parameters.ratio >= one) & (parameters.second >= one);
    const F low = S::min(x, y), high = S::max(x, y);
    F bounds[5] = {enter, S::min(low, z), S::max(low, S::min(high, z)), S::max(high, z), leave};
    for (int i = 1; i < 4; ++i)
      bounds[i] = S::select(f.convex, leave, S::min(S::max(bounds[i], enter), leave));
    // A ray that starts here goes inward, and leaves the shape next, or outward, and enters it next; another
    // crossing before that is the start itself.
    M starts = rays.starts_here, inward = M::none();
    F value, slope;
    if (starts.bits() != 0) {
      f.at(-shift, value, slope);
      inward = slope < zero;
    }
    F distance[4] = {zero, zero, zero, zero};
    M hit[4] = {M::none(), M::none(), M::none(), M::none()};
    f.at(bounds[0], value, slope);
    for (int i = 0; i < 4; ++i) {
      const M outside = value > zero, wanted = in_box & (bounds[i] < bounds[i + 1]);
      if (wanted.bits() == 0) continue;
      f.at(bounds[i + 1], value, slope);
      const M crosses = wanted & ((outside & (value <= zero)) | ((value > zero) & !outside));
      F middle = bounds[i + 1];
      const M turns = f.other_side(bounds[i], middle, outside, wanted & !crosses);
      for (int half_way = 0; half_way < 2; ++half_way) {
        const bool first = half_way == 0;
        const M here = first ? crosses | turns : turns, enters = first ? outside : !outside;
        if (here.bits() == 0) break;
        const F t =
            (f.root_between(first ? bounds[i] : middle, first ? middle : bounds[i + 1], enters, here) +
             shift) *
            inverse_scale;
        const M next = (t > zero) & ((inward & !enters) | (enters & !inward));
        M put = here & !(starts & !next);
        starts = starts & !put;
        for (int place = 0; place < 4; ++place) {
          const M free = put & !hit[place];
          distance[place] = S::select(free, t, distance[place]);
          hit[place] = hit[place] | free;
          put = put & !free;
        }
      }
    }
    for (uint32_t pair = 0; pair < kCrossingPairs; ++pair) {
      Crossings<S>& c = crossings[pair];
      c.near = distance[2 * pair];
      c.far = distance[2 * pair + 1];
      c.near_hit = hit[2 * pair];
      c.far_hit = hit[2 * pair + 1];
    }
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>& parameters) {
    return Terms<S>(p, parameters).root() < typename S::F(1.0f);
  }

  template <class S>
  [[gnu::always_inline]] static V3<S> gradient(const V3<S>& p, const LocalParameters<S>& parameters) {
    V3<S> slope;
    Profile<S>::root_at(p, parameters, slope);
    return slope;
  }

  static LocalBounds local_bounds(float) { return {-1.0f, 1.0f, 1.0f, true}; }

private:
  static constexpr float kLeast = 1e-37f;

  /// What the equation says at a point.
  template <class S> struct Terms {
    using F = typename S::F;
    /// |x|^p, |y|^p, |z|^q, the sum of the first two to the power q/p, and that of the next two to the power
    /// 1/q.
    F power[5];

    [[gnu::always_inline]] Terms(const V3<S>& at, const LocalParameters<S>& parameters) {
      const F p = S::max(parameters.ratio, F(kLeast)), q = S::max(parameters.second, F(kLeast));
      F base[5] = {S::abs(at.x), S::abs(at.y), S::abs(at.z)};
      const F exponent[5] = {p, p, q, q / p, F(1.0f) / q};
      // A loop, as local store has room for one copy of powers.
      for (int i = 0; i < 5; ++i) {
        if (i == 3) base[i] = power[0] + power[1];
        if (i == 4) base[i] = sum();
        power[i] = pow<S>(base[i], exponent[i]);
      }
    }
    [[gnu::always_inline]] F sum() const { return power[3] + power[2]; }
    [[gnu::always_inline]] F root() const { return power[4]; }
    /// Of the root.
    [[gnu::always_inline]] V3<S> gradient(const V3<S>& at) const {
      const F along = root() / S::max(sum(), F(kLeast));
      const F across = along * power[3] / S::max(power[0] + power[1], F(kLeast));
      return {across * power[0] * inverse(at.x), across * power[1] * inverse(at.y),
              along * power[2] * inverse(at.z)};
    }

  private:
    /// Cusps are at 0, where the gradient has no end.
    [[gnu::always_inline]] static F inverse(const F& x) {
      const F away = S::max(S::abs(x), F(1e-7f));
      return F(1.0f) / S::select(x < F(0.0f), -away, away);
    }
  };

  /// Along a ray.
  template <class S> struct Profile {
    using F = typename S::F;
    using M = typename S::M;
    LocalParameters<S> parameters;
    V3<S> o, d;
    M convex;

    /// One copy of it, for rays and for normals.
    [[gnu::noinline]] static F root_at(const V3<S>& p, const LocalParameters<S>& parameters,
                                       V3<S>& gradient) {
      const Terms<S> terms(p, parameters);
      gradient = terms.gradient(p);
      return terms.root();
    }

    /// The root of the sum, less 1: below 0 inside.
    [[gnu::noinline]] void at(const F& t, F& value, F& slope) const {
      V3<S> gradient;
      value = root_at(o + d * t, parameters, gradient) - F(1.0f);
      slope = dot<S>(gradient, d);
    }

    /// Of the rays `wanted`, which are on the same side at `low` and `high`, those that are on the other one
    /// in between: there `high` becomes a place where they are.
    [[gnu::noinline]] M other_side(F low, F& high, const M& outside, M wanted) const {
      M found = M::none();
      if (wanted.bits() == 0) return found;
      const F zero(0.0f), sign = S::select(outside, F(1.0f), F(-1.0f));
      const F margin = (high - low) * F(1e-4f); // off cusps, at which slopes mean nothing
      F end = high - margin, at_low, at_end, slope_low, slope_end;
      low = low + margin;
      at(low, at_low, slope_low);
      at(end, at_end, slope_end);
      at_low = at_low * sign, slope_low = slope_low * sign;
      at_end = at_end * sign, slope_end = slope_end * sign;
      wanted = wanted & (slope_low < zero) & (slope_end > zero);
      for (int i = 0; i < 14 && wanted.bits() != 0; ++i) {
        // Where the tangents meet: nothing convex comes below that.
        const F width = end - low;
        const F meet = (at_low - at_end + slope_end * width) / S::max(slope_end - slope_low, F(1e-20f));
        wanted = wanted & !(convex & (at_low + slope_low * meet > zero));
        const F t = low + S::select((meet > zero) & (meet < width), meet, width * F(0.5f));
        F value, slope;
        at(t, value, slope);
        value = value * sign, slope = slope * sign;
        const M is_there = wanted & (value < zero);
        high = S::select(is_there, t, high);
        found = found | is_there;
        wanted = wanted & !is_there;
        const M falls = slope < zero;
        low = S::select(falls, t, low);
        at_low = S::select(falls, value, at_low);
        slope_low = S::select(falls, slope, slope_low);
        end = S::select(falls, end, t);
        at_end = S::select(falls, at_end, value);
        slope_end = S::select(falls, slope_end, slope);
      }
      return found;
    }

    /// Of the rays `wanted`, the crossing between `low` and `high`; `falls`: outside at `low`. The result of
    /// a ray depends on no other ray.
    [[gnu::noinline]] F root_between(F low, F high, const M& falls, M wanted) const {
      const F sign = S::select(falls, F(-1.0f), F(1.0f)), half(0.5f);
      F t = (low + high) * half;
      for (int i = 0; i < 20 && wanted.bits() != 0; ++i) {
        F value, slope;
        at(t, value, slope);
        value = value * sign;
        const M root_is_above = value <= F(0.0f);
        low = S::select(root_is_above, t, low);
        high = S::select(root_is_above, high, t);
        const F newton = t - value / S::max(slope * sign, F(1e-20f));
        const M sane = (newton >= low) & (newton <= high);
        const F next = S::select(sane, newton, (low + high) * half);
        const M moves = S::abs(next - t) > F(kConverged);
        t = S::select(wanted, next, t);
        wanted = wanted & moves;
      }
      return t;
    }
  };

  /// Newton's method ends where it moves less than this: the next step would be in the order of its square.
  static constexpr float kConverged = 1e-5f;
};

} // namespace celltrace::kernel
