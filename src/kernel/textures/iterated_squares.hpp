// Iteration of complex numbers that are squared and moved by a constant: the Mandelbrot set and Julia sets of
// the second order. Kernel dialect.
#pragma once

#include "celltrace/spe/simd.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

template <class S> struct Complex { typename S::F a, b; };

/// Numbers that are squared, with the rounds that they stay bounded and, for bounded numbers, the least size.
template <class S, bool kWantsLeast> struct IteratedSquares {
  using F = typename S::F;

  Complex<S> z;
  F aa, bb; ///< squares of the parts of z
  F least, rounds;
  typename S::M bounded;

  explicit IteratedSquares(const Complex<S>& first)
      : z(first), aa(first.a * first.a), bb(first.b * first.b), least(aa + bb), rounds(0.0f),
        bounded(S::M::all()) {}

  [[gnu::always_inline]] void iterate(const Complex<S>& c) {
    const F ab = z.a * z.b;
    z = {aa - bb + c.a, ab + ab + c.b};
    aa = z.a * z.a;
    bb = z.b * z.b;
    const F size = aa + bb;
    bounded = bounded & (size <= F(4.0f));
    rounds = S::select(bounded, rounds + F(1.0f), rounds);
    if constexpr (kWantsLeast) least = S::select(bounded, S::min(least, size), least);
  }
  [[gnu::always_inline]] typename S::M is_at(const Complex<S>& place) const {
    return (z.a == place.a) & (z.b == place.b);
  }
};

/// Returns the numbers in the two largest parts of the Mandelbrot set, except those near the edge.
template <class S> [[gnu::always_inline]] inline typename S::M surely_bounded(const Complex<S>& c) {
  using F = typename S::F;
  constexpr float kRounding = 5e-7f; // bound for the sum of all terms, none of which is above 1
  const F x = c.a - F(0.25f), y = c.b * c.b, q = x * x + y, from_disc = c.a + F(1.0f);
  const auto in_cardioid = q * (q + x) + F(kRounding) < y * F(0.25f);
  return in_cardioid | (from_disc * from_disc + y < F(0.0625f - kRounding));
}

/// The parameters of a fractal pattern that only iterates squares and counts rounds.
struct SquareIteration {
  const PatternRecord& record;

  /// Returns true if a pattern is such a fractal: outside it counts rounds, and inside it has the least size
  /// or only a factor.
  static bool describes(const PatternRecord& r) {
    return part(r, fractal_word::magnet_shift, fractal_word::magnet_mask) == 0 &&
           (r.table & fractal_word::exponent_mask) == 2 &&
           part(r, fractal_word::exterior_shift, fractal_word::type_mask) == 1 &&
           part(r, fractal_word::interior_shift, fractal_word::type_mask) <= 1;
  }
  bool wants_least() const {
    return part(record, fractal_word::interior_shift, fractal_word::type_mask) == 1;
  }
  bool is_julia() const { return (record.table & fractal_word::julia) != 0; }
  template <class S> Complex<S> constant(const Complex<S>& at) const {
    using F = typename S::F;
    return is_julia() ? Complex<S>{F(record.parameter[0]), F(record.parameter[1])} : at;
  }
  uint32_t most() const { return static_cast<uint32_t>(record.parameter[2]); }
  float inner() const { return record.parameter[4]; }
  template <class S> typename S::F outer(const typename S::F& rounds) const {
    return rounds * typename S::F(1.0f / record.parameter[2]);
  }

private:
  static uint32_t part(const PatternRecord& r, uint32_t shift, uint32_t mask) {
    return r.table >> shift & mask;
  }
};

} // namespace celltrace::kernel
