// The superellipsoid: (|x|^p + |y|^p)^(q/p) + |z|^q = 1 of its space, where p is `ratio` and q is `second`.
// Kernel dialect.
//
// Crossings are sought by the sum's root, to the power 1/q: like a distance, this root grows in proportion to
// a point's distance from the centre, so that single precision suffices for any exponents. If p and q are 1
// or more the shape is convex: no tangent rises above the root, so that Newton's method leads from outside to
// the crossing and not beyond it. Otherwise the shape is thin along the planes between the octants, which
// divide the line into intervals with at most one turn of the root.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/primitives/local_shape.hpp"

#include <type_traits>

namespace celltrace::kernel {

struct SuperellipsoidPrimitive : LocalPrimitive<SuperellipsoidPrimitive> {
  static constexpr const char* kName = "superellipsoid";
  static constexpr uint32_t kCrossingPairs = 2;
  static constexpr bool kHasParameters = true;
  static constexpr bool kIsHeavy = true;
  static constexpr bool kHasHeavyPoints = true;

  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>& parameters,
                              Crossings<S>* crossings) {
    using F = typename S::F;
    using M = typename S::M;
    for (uint32_t pair = 0; pair < kCrossingPairs; ++pair)
      crossings[pair].clear();
    const Line<S> line(rays, parameters);
    if (line.in_box.bits() == 0) return;
    const F one(1.0f);
    // All rays have one shape.
    const bool is_convex = ((parameters.ratio >= one) & (parameters.second >= one)).bits() != 0;
    // A ray that starts here leaves the shape next if it goes inward, and otherwise enters the shape next. A
    // crossing before that is the start itself.
    const M inward = line.goes_inward(rays.starts_here);
    if (!is_convex) return line.cross_thin(rays.starts_here, inward, crossings);
    Crossings<S>& c = crossings[0];
    F near = line.enter, far = line.leave;
    M active = line.in_box;
    if constexpr (Line<S>::kHasRoom) active = active & (inward | !rays.starts_here);
    const M crosses = line.cross_convex(near, far, active);
    c.near = line.distance_at(near);
    c.far = line.distance_at(far);
    c.near_hit = crosses & !rays.starts_here;
    c.far_hit = crosses & (inward | !rays.starts_here);
    if constexpr (Line<S>::kHasRoom) c.far_hit = c.far_hit & !(c.near_hit & line.is_enough(c.near));
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>& parameters) {
    return Terms<S>(p, Exponents<S>(parameters)).root() < typename S::F(1.0f);
  }

  template <class S>
  [[gnu::always_inline]] static V3<S> gradient(const V3<S>& p, const LocalParameters<S>& parameters) {
    return Terms<S>(p, Exponents<S>(parameters)).gradient(p);
  }

  static LocalBounds local_bounds(float) { return {-1.0f, 1.0f, 1.0f, true}; }

private:
  static constexpr float kLeast = 1e-37f;

  /// Exponents of the powers in Terms.
  template <class S> struct Exponents {
    using F = typename S::F;
    F of[5];

    explicit Exponents(const LocalParameters<S>& parameters) {
      const F p = S::max(parameters.ratio, F(kLeast)), q = S::max(parameters.second, F(kLeast));
      of[0] = of[1] = p;
      of[2] = q;
      of[3] = q / p;
      of[4] = F(1.0f) / q;
    }
    [[gnu::always_inline]] F raise(int number, const F& x) const { return pow<S>(x, of[number]); }
  };

  /// Exponents if all lanes have one shape, where there is room for more code: products and square roots take
  /// less time than other powers.
  template <class S> struct ExponentsOfOne : Exponents<S> {
    using F = typename S::F;
    /// n > 0: the power is a product of n factors; n < 0: the square root is taken -n times; 0: neither.
    int times[5];

    explicit ExponentsOfOne(const LocalParameters<S>& parameters) : Exponents<S>(parameters) {
      for (int i = 0; i < 5; ++i) {
        alignas(64) float exponents[S::kLanes];
        this->of[i].store(exponents);
        times[i] = times_of(exponents[0]);
      }
    }
    [[gnu::always_inline]] F raise(int number, const F& x) const {
      const int n = times[number];
      return n > 0 ? product(x, n) : n < 0 ? root(x, -n) : Exponents<S>::raise(number, x);
    }

  private:
    static int times_of(float exponent) {
      const int whole = exponent <= 16.0f ? static_cast<int>(exponent) : 0;
      if (static_cast<float>(whole) == exponent) return whole;
      return exponent == 0.5f ? -1 : exponent == 0.25f ? -2 : exponent == 0.125f ? -3 : 0;
    }
    static F product(const F& x, int n) {
      if (n == 1) return x;
      // Products of still smaller numbers may be denormal, and do not matter in a sum of about 1.
      F factor = S::max(x, F(n < 4 ? 1e-12f : 0.0055f)), all(1.0f);
      for (;; factor = factor * factor) {
        if ((n & 1) != 0) all = all * factor;
        if ((n >>= 1) == 0) return all;
      }
    }
    static F root(F x, int n) {
      for (int i = 0; i < n; ++i)
        x = S::sqrt(x);
      return x;
    }
  };

  /// The terms of the equation at a point.
  template <class S> struct Terms {
    using F = typename S::F;
    /// Values of |x|^p, |y|^p, |z|^q, the sum of the first two to the power q/p, and the sum of the previous
    /// two to the power 1/q.
    F power[5];

    template <class Powers> [[gnu::always_inline]] Terms(const V3<S>& at, const Powers& powers) {
      F base[5] = {S::abs(at.x), S::abs(at.y), S::abs(at.z)};
      // In a loop, as local store has room for one copy of powers.
      for (int i = 0; i < 5; ++i) {
        if (i == 3) base[i] = power[0] + power[1];
        if (i == 4) base[i] = sum();
        power[i] = powers.raise(i, base[i]);
      }
    }
    [[gnu::always_inline]] F sum() const { return power[3] + power[2]; }
    [[gnu::always_inline]] F root() const { return power[4]; }
    /// Returns the gradient of the root.
    [[gnu::always_inline]] V3<S> gradient(const V3<S>& at) const {
      const F along = root() / S::max(sum(), F(kLeast));
      const F across = along * power[3] / S::max(power[0] + power[1], F(kLeast));
      return {across * power[0] * inverse(at.x), across * power[1] * inverse(at.y),
              along * power[2] * inverse(at.z)};
    }

  private:
    /// Returns 1 / x, limited near cusps at 0, where the gradient is infinite.
    [[gnu::always_inline]] static F inverse(const F& x) {
      const F away = S::max(S::abs(x), F(1e-7f));
      return F(1.0f) / S::select(x < F(0.0f), -away, away);
    }
  };

  /// The lines of rays, by the distance in the shape's space from the point that is closest to the centre.
  template <class S> struct Line {
    using F = typename S::F;
    using M = typename S::M;
    /// True if there is room for code that leaves out crossings that are not wanted.
    static constexpr bool kHasRoom = S::kLanes == kSimdLanes;

    std::conditional_t<kHasRoom, ExponentsOfOne<S>, Exponents<S>> exponents;
    F inverse_scale, shift; ///< scale and offset of distances along rays
    V3<S> o, d;
    V3<S> planes; ///< distances of the planes between octants
    /// The interval in a slightly extended box, so that both ends are certainly outside of the shape.
    F enter, leave;
    M in_box;
    /// If kHasRoom: the rays, and the distance from which on crossings are wanted.
    const LocalRays<S>* line_rays;
    F begin;

    Line(const LocalRays<S>& rays, const LocalParameters<S>& parameters) : exponents(parameters) {
      const F reach(1.001f);
      inverse_scale = F(1.0f) / S::sqrt(S::max(dot<S>(rays.direction, rays.direction), F(1e-30f)));
      d = rays.direction * inverse_scale;
      shift = -dot<S>(rays.origin, d);
      o = rays.origin + d * shift;
      const V3<S> inverse = {finite_inverse<S>(d.x), finite_inverse<S>(d.y), finite_inverse<S>(d.z)};
      planes = {-o.x * inverse.x, -o.y * inverse.y, -o.z * inverse.z};
      const V3<S> half = {S::abs(inverse.x) * reach, S::abs(inverse.y) * reach, S::abs(inverse.z) * reach};
      enter = max_component<S>(planes - half);
      leave = S::min(planes.x + half.x, S::min(planes.y + half.y, planes.z + half.z));
      in_box = enter < leave;
      if constexpr (kHasRoom) {
        const FloatLanes* const limit = rays.request->limit;
        line_rays = &rays;
        begin = limit != nullptr ? -shift : F(-kEveryCrossing);
        if (limit != nullptr)
          in_box = in_box & (leave > begin) & (distance_at(enter) <= F::load(limit->lane));
      }
    }

    F distance_at(const F& t) const { return (t + shift) * inverse_scale; }
    /// Returns true if crossings after this one need not be found.
    M is_enough(const F& distance) const { return distance > F(line_rays->request->enough); }

    /// Returns the rays that start on the shape and go inward.
    M goes_inward(const M& start) const {
      if (start.bits() == 0) return M::none();
      F value, slope;
      at(-shift, value, slope);
      return slope < F(0.0f);
    }

    /// Finds terms.root() - 1 at distance `t`, and its slope along the ray. The value is negative inside the
    /// shape.
    CELLTRACE_ONE_COPY void at(const F& t, F& value, F& slope) const {
      const V3<S> p = o + d * t;
      const Terms<S> terms(p, exponents);
      value = terms.root() - F(1.0f);
      slope = dot<S>(terms.gradient(p), d);
    }

    /// Returns the rays of `wanted` that cross a convex shape: `near` and `far`, outside in front of and
    /// behind the shape, move to the crossings. If kHasRoom, `near` does not move for rays that start on the
    /// shape, nor `far` if `near` is enough. The result of a ray depends on no other ray.
    CELLTRACE_ONE_COPY M cross_convex(F& near, F& far, M wanted) const {
      const F zero(0.0f);
      for (int end = 0; end < 2; ++end) {
        const F ahead(end == 0 ? 1.0f : -1.0f), limit = end == 0 ? far : near;
        F t = end == 0 ? near : far;
        M moves = wanted;
        if constexpr (kHasRoom) {
          const M starts = line_rays->starts_here;
          moves = moves & (end == 0 ? !starts : starts | !is_enough(distance_at(near)));
        }
        for (int i = 0; i < 30 && moves.bits() != 0; ++i) {
          F above, along;
          at(t, above, along);
          along = along * ahead;
          // A ray misses the shape if the value rises, or the other end is reached.
          const M misses = moves & (above > zero) & ((along >= zero) | ((limit - t) * ahead <= zero));
          wanted = wanted & !misses;
          moves = moves & !misses;
          const F step = above / S::max(-along, F(1e-20f));
          t = S::select(moves, t + step * ahead, t);
          moves = moves & (step > F(kConverged));
        }
        (end == 0 ? near : far) = t;
      }
      return wanted;
    }

    /// Finds the crossings with a shape that may be entered twice. The first crossing of a ray that starts on
    /// the shape is the next one behind the start, according to `inward`.
    void cross_thin(M starts, const M& inward, Crossings<S>* crossings) const {
      const F zero(0.0f);
      const F low = S::min(planes.x, planes.y), high = S::max(planes.x, planes.y);
      F bounds[5] = {enter, S::min(low, planes.z), S::max(low, S::min(high, planes.z)),
                     S::max(high, planes.z), leave};
      for (int i = 1; i < 4; ++i)
        bounds[i] = S::min(S::max(bounds[i], enter), leave);
      if constexpr (kHasRoom) {
        for (int i = 1; i < 4; ++i)
          bounds[0] = S::select(bounds[i] < begin, bounds[i], bounds[0]);
        for (int i = 1; i < 4; ++i)
          bounds[i] = S::max(bounds[i], bounds[0]);
      }
      M active = in_box;
      F distance[4] = {zero, zero, zero, zero};
      M hit[4] = {M::none(), M::none(), M::none(), M::none()};
      F value, slope;
      at(bounds[0], value, slope);
      for (int i = 0; i < 4; ++i) {
        const M outside = value > zero, wanted = active & (bounds[i] < bounds[i + 1]);
        if (wanted.bits() == 0) continue;
        at(bounds[i + 1], value, slope);
        const M crosses = wanted & ((outside & (value <= zero)) | ((value > zero) & !outside));
        F middle = bounds[i + 1];
        const M turns = other_side(bounds[i], middle, outside, wanted & !crosses);
        for (int half_way = 0; half_way < 2; ++half_way) {
          const bool first = half_way == 0;
          const M here = first ? crosses | turns : turns, enters = first ? outside : !outside;
          if (here.bits() == 0) break;
          const F t = distance_at(
              root_between(first ? bounds[i] : middle, first ? middle : bounds[i + 1], enters, here));
          const M next = (t > zero) & ((inward & !enters) | (enters & !inward));
          M put = here & !(starts & !next);
          starts = starts & !put;
          if constexpr (kHasRoom) active = active & !(put & is_enough(t));
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

  private:
    /// Returns the rays of `wanted`, on one side of the surface at `low` and `high`, that are on the other
    /// side in between; `high` moves to such a place.
    CELLTRACE_ONE_COPY M other_side(F low, F& high, const M& outside, M wanted) const {
      M found = M::none();
      if (wanted.bits() == 0) return found;
      const F zero(0.0f), sign = S::select(outside, F(1.0f), F(-1.0f));
      const F margin = (high - low) * F(1e-4f); // off cusps, at which slopes are meaningless
      F end = high - margin, at_low, at_end, slope_low, slope_end;
      low = low + margin;
      at(low, at_low, slope_low);
      at(end, at_end, slope_end);
      at_low = at_low * sign, slope_low = slope_low * sign;
      at_end = at_end * sign, slope_end = slope_end * sign;
      wanted = wanted & (slope_low < zero) & (slope_end > zero);
      for (int i = 0; i < 14 && wanted.bits() != 0; ++i) {
        // The next place is where the tangents meet.
        const F width = end - low;
        const F meet = (at_low - at_end + slope_end * width) / S::max(slope_end - slope_low, F(1e-20f));
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

    /// Returns the crossing between `low` and `high` for the rays `wanted`; `falls`: outside at `low`. The
    /// result of a ray depends on no other ray.
    CELLTRACE_ONE_COPY F root_between(F low, F high, const M& falls, M wanted) const {
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

  /// Step below which Newton's method ends: the next step would be in the order of its square.
  static constexpr float kConverged = 1e-5f;
};

} // namespace celltrace::kernel
