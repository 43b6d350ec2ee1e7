// The fractal pattern: the Mandelbrot set, Julia sets and related sets in the xy plane, by iteration of
// complex numbers. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/iterated_squares.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

/// The parameters are Julia's constant, the number of iterations, and the factors of the colouring outside
/// and inside. Numbers and words of the colouring are POV-Ray's.
struct FractalPattern : RarePattern {
  static constexpr const char* kName = "fractal";

  template <class Spu>
  [[gnu::always_inline]] static typename Spu::rare_simd::F value([[maybe_unused]] SceneAccess<Spu>& scene,
                                                                 const V3<typename Spu::rare_simd>& p,
                                                                 const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    using M = typename S::M;
    F of_squares(0.0f);
    if (Strategy<Spu>::template find_squares<Spu>(scene, Complex<S>{p.x, p.y}, r, of_squares))
      return of_squares;
    const uint32_t magnet = r.table >> fractal_word::magnet_shift & fractal_word::magnet_mask;
    const bool is_julia = (r.table & fractal_word::julia) != 0;
    const Complex<S> c = is_julia ? Complex<S>{F(r.parameter[0]), F(r.parameter[1])} : Complex<S>{p.x, p.y};
    Complex<S> z = {p.x, p.y};
    F least = square<S>(z), rounds(0.0f);
    if (magnet != 0 && !is_julia) {
      z = {F(0.0f), F(0.0f)};
      least = F(1e30f); // so that the first number does not count
    }
    const uint32_t outside = r.table >> fractal_word::exterior_shift & fractal_word::type_mask;
    const uint32_t inside = r.table >> fractal_word::interior_shift & fractal_word::type_mask;
    const uint32_t most = static_cast<uint32_t>(r.parameter[2]);
    M bounded = M::all();
    // Numbers that have left are iterated further, so that no number waits for the test which have left.
    Complex<S> left = z;
    for (uint32_t i = 0; i < most; ++i) {
      z = magnet == 0 ? plus<S>(power<S>(z, r.table & fractal_word::exponent_mask), c)
                      : magnetic<S>(z, c, magnet);
      const F size = square<S>(z);
      M leaves = size > F(magnet == 0 ? 4.0f : 10000.0f);
      if (magnet != 0) leaves = leaves | (square<S>({z.a - F(1.0f), z.b}) < F(0.0001f));
      leaves = leaves & bounded;
      left = {S::select(leaves, z.a, left.a), S::select(leaves, z.b, left.b)};
      bounded = bounded & !leaves;
      if (bounded.bits() == 0) break;
      rounds = S::select(bounded, F(static_cast<float>(i + 1)), rounds);
      least = S::select(bounded, S::min(least, size), least);
    }
    const F factor(r.parameter[3]), inner(r.parameter[4]);
    const F of_outside = outside == 1   ? rounds * F(1.0f / r.parameter[2])
                         : outside == 6 ? S::sqrt(square<S>(left)) * factor
                         : outside > 6  ? remaining<S>(rounds, outside, factor)
                                        : counted<S>(left, outside, factor);
    const F of_inside =
        inside == 1   ? S::sqrt(least) * inner
        : inside == 6 ? z.a * z.a + z.b * z.b * inner // as in POV-Ray, the factor is that of one part only
        : inside > 6  ? remaining<S>(F(r.parameter[2]), inside, inner)
                      : counted<S>(z, inside, inner);
    return S::select(bounded, of_inside, of_outside);
  }

private:
  template <class S> [[gnu::always_inline]] static typename S::F square(const Complex<S>& z) {
    return z.a * z.a + z.b * z.b;
  }
  template <class S> [[gnu::always_inline]] static Complex<S> plus(const Complex<S>& z, const Complex<S>& w) {
    return {z.a + w.a, z.b + w.b};
  }
  template <class S>
  [[gnu::always_inline]] static Complex<S> times(const Complex<S>& z, const Complex<S>& w) {
    return {z.a * w.a - z.b * w.b, z.a * w.b + z.b * w.a};
  }
  template <class S> [[gnu::always_inline]] static Complex<S> power(const Complex<S>& z, uint32_t exponent) {
    Complex<S> result = z;
    for (uint32_t i = 1; i < exponent; ++i)
      result = times<S>(result, z);
    return result;
  }
  /// Returns the square of (z^2 + c - 1) / (2z + c - 2), or of the corresponding quotient with cubes.
  template <class S>
  [[gnu::always_inline]] static Complex<S> magnetic(const Complex<S>& z, const Complex<S>& c, uint32_t kind) {
    using F = typename S::F;
    const F one(1.0f), two(2.0f), three(3.0f);
    const Complex<S> c1 = {c.a - one, c.b}, c2 = {c.a - two, c.b}, zz = times<S>(z, z);
    Complex<S> upper, lower;
    if (kind == 1) {
      upper = plus<S>(zz, c1);
      lower = {z.a + z.a + c2.a, z.b + z.b + c2.b};
    } else {
      const Complex<S> product = times<S>(c1, c2), slope = times<S>(c2, z);
      const Complex<S> cubic = times<S>(z, {zz.a + three * c1.a, zz.b + three * c1.b});
      upper = plus<S>(cubic, product);
      lower = {three * (zz.a + slope.a) + product.a + one, three * (zz.b + slope.b) + product.b};
    }
    const F inverse = one / S::max(square<S>(lower), F(1e-30f));
    const Complex<S> quotient = times<S>(upper, {lower.a * inverse, -lower.b * inverse});
    return times<S>(quotient, quotient);
  }
  /// Returns a value of a type that is the same inside and outside of the set: the factor (type 0), or the
  /// factor times the imaginary or real part of the last number, or times the square of this part.
  template <class S>
  [[gnu::always_inline]] static typename S::F counted(const Complex<S>& z, uint32_t type,
                                                      const typename S::F& factor) {
    if (type == 0) return factor;
    const typename S::F part = (type & 1) == 0 ? z.a : z.b;
    return type < 4 ? part * factor : part * part * factor;
  }
  /// Returns the remainder of the rounds divided by the whole part of the factor, or by this part plus 1,
  /// over the factor.
  template <class S>
  [[gnu::always_inline]] static typename S::F remaining(const typename S::F& rounds, uint32_t type,
                                                        const typename S::F& factor) {
    using F = typename S::F;
    const F divisor = S::max(S::floor(factor) + F(type == 7 ? 0.0f : 1.0f), F(1.0f));
    // Half a round is added so that an exact quotient is not rounded down.
    const F times = S::floor((rounds + F(0.5f)) / divisor);
    return (rounds - times * divisor) / S::max(factor, F(kLeastFactor));
  }
  static constexpr float kLeastFactor = 1e-30f;
};

} // namespace celltrace::kernel
