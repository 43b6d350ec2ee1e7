// The quadric: a x^2 + b y^2 + c z^2 + l z + k = 0 of its space, where each factor is -1, 0 or 1. Negative
// values are inside. Kernel dialect.
#pragma once

#include "kernel/primitives/plane.hpp"

namespace celltrace::kernel {

struct QuadricPrimitive : LocalPrimitive<QuadricPrimitive> {
  static constexpr const char* kName = "quadric";
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasParameters = true;
  static constexpr bool kIsBounded = false;
  static constexpr bool kIsHeavy = true;

  /// Returns the `ratio` of a quadric: its factors as the digits of a number.
  static constexpr float code(int a, int b, int c, int l, int k) {
    return static_cast<float>((((k + 1) * 2 + l) * 3 + c + 1) * 9 + (b + 1) * 3 + a + 1);
  }
  template <class S> struct Factors {
    using F = typename S::F;
    V3<S> square;
    F linear, constant;

    [[gnu::always_inline]] explicit Factors(const LocalParameters<S>& parameters) {
      // The last digits are removed separately for each factor, so that no factor waits for another.
      const auto without = [&](float base) __attribute__((always_inline)) {
        return S::floor((parameters.ratio + F(0.5f)) * F(1.0f / base));
      };
      const F one(1.0f), three(3.0f);
      const F after_x = without(3.0f), after_y = without(9.0f), after_z = without(27.0f);
      const F after_linear = without(54.0f);
      square = {parameters.ratio - after_x * three - one, after_x - after_y * three - one,
                after_y - after_z * three - one};
      linear = after_z - after_linear * F(2.0f);
      constant = after_linear - one;
    }
    [[gnu::always_inline]] F at(const V3<S>& p) const {
      return dot<S>(square * p, p) + linear * p.z + constant;
    }
  };

  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>& parameters,
                              Crossings<S>* crossings) {
    using F = typename S::F;
    using M = typename S::M;
    const Factors<S> f(parameters);
    const V3<S>& d = rays.direction;
    // The equation starts from the ray's point closest to the middle: far origins would cancel all digits.
    const F middle = -dot<S>(rays.origin, d) * finite_inverse<S>(dot<S>(d, d));
    const V3<S> o = rays.origin + d * middle;
    const V3<S> bent = f.square * d;
    const F a = dot<S>(bent, d), b = dot<S>(bent, o) + f.linear * d.z * F(0.5f), c = f.at(o);
    const F discriminant = b * b - a * c;
    const M real = discriminant >= F(0.0f);
    crossings->clear();
    if (real.bits() == 0) return;
    const F root = S::sqrt(S::max(discriminant, F(0.0f)));
    const F q = -(b + S::select(b < F(0.0f), -root, root));
    const F first = c * finite_inverse<S>(q) + middle, second = q * finite_inverse<S>(a) + middle;
    // A ray that starts on the surface may cross it once more, elsewhere.
    const M starts_first = S::abs(first) <= S::abs(second);
    const M first_hit = real & !(rays.starts_here & starts_first);
    const M second_hit = real & !(rays.starts_here & !starts_first);
    const M in_turn = first <= second;
    Crossings<S>& crossing = *crossings;
    crossing.near = S::min(first, second);
    crossing.far = S::max(first, second);
    crossing.near_hit = (first_hit & in_turn) | (second_hit & !in_turn);
    crossing.far_hit = (second_hit & in_turn) | (first_hit & !in_turn);
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>& parameters) {
    return Factors<S>(parameters).at(p) < typename S::F(0.0f);
  }

  template <class S>
  [[gnu::always_inline]] static V3<S> gradient(const V3<S>& p, const LocalParameters<S>& parameters) {
    const Factors<S> f(parameters);
    const V3<S> half = f.square * p;
    return {half.x, half.y, half.z + f.linear * typename S::F(0.5f)};
  }

  /// Returns unlimited bounds, as for planes.
  static LocalBounds local_bounds(float) { return PlanePrimitive::local_bounds(0.0f); }
};

} // namespace celltrace::kernel
