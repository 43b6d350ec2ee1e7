// Elementary functions of 16 lanes, written with the SIMD facade so that every backend computes the same
// bits. Kernel dialect. Accuracy figures are for the host's single precision.
#pragma once

#include "celltrace/spe/one_copy.hpp"

#include <stdint.h>

namespace celltrace::kernel {

template <class S> struct V3 {
  typename S::F x, y, z;

  friend V3 operator+(const V3& a, const V3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend V3 operator-(const V3& a, const V3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend V3 operator*(const V3& a, const V3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend V3 operator*(const V3& a, const typename S::F& s) { return {a.x * s, a.y * s, a.z * s}; }
};

/// Returns four numbers as lanes without storing them one by one: a processor would wait for the last store.
template <class S> typename S::F4 four(float a, float b, float c, float d) {
  typedef float Four __attribute__((vector_size(16)));
  const Four numbers = {a, b, c, d};
  alignas(16) float lanes[4];
  __builtin_memcpy(lanes, &numbers, sizeof lanes);
  return S::F4::load(lanes);
}

template <class S> V3<S> splat3(const float* v) {
  return {typename S::F(v[0]), typename S::F(v[1]), typename S::F(v[2])};
}
/// Maps a point by an affine map of three rows of four (xyz | offset).
template <class S> V3<S> map_point(const float (&m)[12], const V3<S>& p) {
  using F = typename S::F;
  return {F(m[0]) * p.x + F(m[1]) * p.y + F(m[2]) * p.z + F(m[3]),
          F(m[4]) * p.x + F(m[5]) * p.y + F(m[6]) * p.z + F(m[7]),
          F(m[8]) * p.x + F(m[9]) * p.y + F(m[10]) * p.z + F(m[11])};
}
/// Returns the dot product. Without `inline`, GCC calls this function if vectors take two registers.
template <class S> inline typename S::F dot(const V3<S>& a, const V3<S>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class S> V3<S> cross(const V3<S>& a, const V3<S>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class S> V3<S> select(const typename S::M& m, const V3<S>& a, const V3<S>& b) {
  return {S::select(m, a.x, b.x), S::select(m, a.y, b.y), S::select(m, a.z, b.z)};
}
template <class S> typename S::F absolute_sum(const V3<S>& v) {
  return S::abs(v.x) + S::abs(v.y) + S::abs(v.z);
}
/// Returns v with length 1; a vector of length 0 stays 0.
template <class S> V3<S> normalise(const V3<S>& v) {
  const typename S::F length = S::sqrt(dot<S>(v, v));
  return v * (typename S::F(1.0f) / S::max(length, typename S::F(1e-30f)));
}
template <class S> typename S::F max_component(const V3<S>& v) {
  return S::max(v.x, S::max(v.y, v.z));
}
/// Returns the luminance with POV-Ray's weights.
template <class S> typename S::F grey(const V3<S>& v) {
  return v.x * typename S::F(0.297f) + v.y * typename S::F(0.589f) + v.z * typename S::F(0.114f);
}

/// Returns x - floor(x) and stores floor(x) in `whole`. The result may be 1 if a negative x is close to 0.
template <class S> typename S::F fraction(const typename S::F& x, typename S::I& whole) {
  const typename S::F below = S::floor(x);
  whole = S::to_int(below);
  return x - below;
}

/// Returns the binary logarithm of x > 0 (normal numbers). The error is below 2e-7: absolute near x = 1,
/// relative elsewhere. log(m) = 2 artanh((m-1)/(m+1)) with m in [sqrt(1/2), sqrt(2)], so that nothing cancels
/// near 1. The series is interpolated at Chebyshev's points to within 1e-9.
template <class S> typename S::F log2(const typename S::F& x) {
  using F = typename S::F;
  using I = typename S::I;
  const I bits = S::bits_of(x);
  I exponent = (S::template shift_right<23>(bits) & I::splat(0xFF)) - I::splat(127);
  F mantissa = S::float_of((bits & I::splat(0x007FFFFF)) | I::splat(0x3F800000));
  const auto upper = mantissa > F(1.41421356f);
  mantissa = S::select(upper, mantissa * F(0.5f), mantissa);
  exponent = S::select(upper, exponent + I::splat(1), exponent);
  const F f = (mantissa - F(1.0f)) / (mantissa + F(1.0f));
  const F g = f * f;
  const F series =
      (F(2.8853900798f) + g * F(0.9617988395f)) + g * g * (F(0.5767151118f) + g * F(0.4317197156f));
  return S::to_float(exponent) + f * series;
}

/// Returns 2 to the power x, clamped to [-126, 126]; relative error below 3e-7. Fractions from -1/2 to 1/2 go
/// through a polynomial interpolated at Chebyshev's points to within 1e-8. Its terms are added in pairs to
/// shorten the chain of dependent additions.
template <class S> typename S::F exp2(const typename S::F& x) {
  using F = typename S::F;
  using I = typename S::I;
  const F clamped = S::min(S::max(x, F(-126.0f)), F(126.0f));
  const I whole = S::to_int(clamped + S::select(clamped < F(0.0f), F(-0.5f), F(0.5f)));
  const F r = clamped - S::to_float(whole), r2 = r * r;
  const F upper = (F(0.0555035711f) + r * F(0.0096180826f)) + r2 * (F(0.0013390863f) + r * F(0.0001545316f));
  const F power = F(1.0f) + r * ((F(0.6931471880f) + r * F(0.2402265076f)) + r2 * upper);
  return power * S::float_of(S::template shift_left<23>(whole + I::splat(127)));
}

/// Returns x to the power y for x >= 0; 0 to any power is 0.
template <class S> typename S::F pow(const typename S::F& x, const typename S::F& y) {
  using F = typename S::F;
  const F positive = S::max(x, F(1e-37f));
  return S::select(x > F(1e-37f), exp2<S>(y * log2<S>(positive)), F(0.0f));
}

/// Returns y clamped and truncated to an exponent of whole_pow(): a whole number from 0 to 7.
template <class S> typename S::I whole_power(const typename S::F& y) {
  using F = typename S::F;
  return S::to_int(S::min(S::max(y, F(0.0f)), F(7.0f)));
}
/// Returns x to a power from 0 to 7, by multiplication.
template <class S> typename S::F whole_pow(const typename S::F& x, const typename S::I& power) {
  using F = typename S::F;
  using I = typename S::I;
  const F second = x * x, one(1.0f);
  const auto without = [&](int32_t bit) { return (power & I::splat(bit)) == I::splat(0); };
  return S::select(without(1), one, x) * S::select(without(2), one, second) *
         S::select(without(4), one, second * second);
}

/// Returns x to the power y for x >= 0, up to 1e38, with fewer operations than pow(). The relative error is
/// below 1e-5 if |y| <= 1, otherwise below |y| * 1e-5. x below 1e-37 counts as 1e-37. The polynomials are
/// interpolated at Chebyshev's points.
template <class S>
[[gnu::always_inline]] inline typename S::F coarse_pow(const typename S::F& x, const typename S::F& y) {
  using F = typename S::F;
  using I = typename S::I;
  const I bits = S::bits_of(S::max(x, F(1e-37f)));
  const F m = S::float_of((bits & I::splat(0x007FFFFF)) | I::splat(0x3F800000)), m2 = m * m;
  const F of_mantissa =
      ((F(-3.029151539f) + m * F(6.066871452f)) + m2 * (F(-5.261682508f) + m * F(3.212800287f))) +
      m2 * m2 * ((F(-1.229291006f) + m * F(0.265024293f)) + m2 * F(-0.024568535f));
  const F of_exponent = S::to_float(S::template shift_right<23>(bits) - I::splat(127));
  const F power = S::min(S::max((of_exponent + of_mantissa) * y + F(127.0f), F(0.0f)), F(254.0f));
  const I exponent = S::to_int(power); // biased exponent, truncated downward
  const F r = power - S::to_float(exponent), r2 = r * r;
  const F mantissa =
      (F(0.999999898f) + r * F(0.693154490f)) +
      r2 * ((F(0.240141818f) + r * F(0.055860337f)) + r2 * (F(0.008949590f) + r * F(0.001893754f)));
  return mantissa * S::float_of(S::template shift_left<23>(exponent));
}

/// Returns the sine of an angle in turns, in [0, 1]; absolute error below 3e-7.
template <class S> typename S::F sine_of_turns(const typename S::F& turns) {
  using F = typename S::F;
  // The series is centred on half a turn. Angles more than a quarter of a turn from the centre are mirrored
  // about the nearer extremum of the sine.
  const F from_middle = turns - F(0.5f);
  const F fold = S::select(from_middle < F(0.0f), F(-0.5f), F(0.5f)) - from_middle;
  const F x = F(6.28318531f) * S::select(S::abs(from_middle) > F(0.25f), fold, from_middle);
  const F square = x * x;
  const F series =
      F(1.0f) -
      square *
          (F(1.0f / 6) -
           square * (F(1.0f / 120) -
                     square * (F(1.0f / 5040) - square * (F(1.0f / 362880) - square * F(1.0f / 39916800)))));
  return -(x * series);
}

/// Returns the arc cosine of x in [0, 1]; absolute error below 3e-7 (Abramowitz and Stegun 4.4.46).
template <class S> typename S::F acos_unit(const typename S::F& x) {
  using F = typename S::F;
  const F p = F(1.5707963050f) +
              x * (F(-0.2145988016f) +
                   x * (F(0.0889789874f) +
                        x * (F(-0.0501743046f) +
                             x * (F(0.0308918810f) + x * (F(-0.0170881256f) +
                                                          x * (F(0.0066700901f) + x * F(-0.0012624911f)))))));
  return S::sqrt(S::max(F(1.0f) - x, F(0.0f))) * p;
}

/// Computes the sine and cosine of x, clamped to [-8192, 8192]. The absolute error is below 2e-7 if |x| <=
/// 100, otherwise that of rounding x.
template <class S>
[[gnu::always_inline]] inline void sin_cos_inline(const typename S::F& x, typename S::F& sine, typename S::F& cosine) {
  using F = typename S::F;
  using I = typename S::I;
  const F angle = S::min(S::max(x, F(-8192.0f)), F(8192.0f));
  const F turns = angle * F(0.636619772f);
  const I quadrant = S::to_int(turns + S::select(turns < F(0.0f), F(-0.5f), F(0.5f)));
  const F n = S::to_float(quadrant);
  // pi / 2 as a sum of three parts: the products of n and the first two are exact.
  const F r = ((angle - n * F(1.5703125f)) - n * F(4.837513e-4f)) - n * F(7.549789954891882e-8f);
  const F r2 = r * r;
  const F s =
      r + r * r2 * (F(-1.0f / 6) + r2 * (F(1.0f / 120) + r2 * (F(-1.0f / 5040) + r2 * F(1.0f / 362880))));
  const F c = F(1.0f) + r2 * (F(-0.5f) + r2 * (F(1.0f / 24) + r2 * (F(-1.0f / 720) + r2 * F(1.0f / 40320))));
  const I one = I::splat(1);
  const auto swapped = (quadrant & one) == one;
  const F first = S::select(swapped, c, s), second = S::select(swapped, s, c);
  const I two = I::splat(2);
  const F zero(0.0f);
  sine = S::select((quadrant & two) == two, zero - first, first);
  cosine = S::select(((quadrant + one) & two) == two, zero - second, second);
}
/// Does sin_cos_inline(). Not inlined: the module of cameras has room for one copy.
template <class S>
CELLTRACE_ONE_COPY void sin_cos(const typename S::F& x, typename S::F& sine, typename S::F& cosine) {
  sin_cos_inline<S>(x, sine, cosine);
}

} // namespace celltrace::kernel
