#include "isa/reference_double.hpp"

#include "isa/exact.hpp"

namespace celltrace::test {

namespace {

constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
constexpr std::uint64_t kInfinity = std::uint64_t{0x7FF} << 52;
constexpr std::uint64_t kDefaultNan = 0x7FF8000000000000;

/// From the last bit of the smallest product, 2^-2148, to twice the largest, 2^2049.
using Value = Exact<66, -2148>;

struct Number {
  enum Kind { zero, finite, infinite, nan } kind;
  bool negative;
  Wide significand = 0; ///< of finite
  int exponent = 0;     ///< of its last bit
};

/// Of the bits of a format; denormals become zeros.
Number number_of(std::uint64_t bits, int exponent_bits, int fraction_bits, DoubleStatus& status) {
  const bool negative = (bits >> (exponent_bits + fraction_bits) & 1) != 0;
  const int highest = (1 << exponent_bits) - 1;
  const int exponent = static_cast<int>(bits >> fraction_bits) & highest;
  const std::uint64_t hidden = std::uint64_t{1} << fraction_bits;
  const std::uint64_t fraction = bits & (hidden - 1);
  if (exponent == highest && fraction != 0) {
    status.exceptions |= exception::nan;
    const bool quiet = (fraction & hidden >> 1) != 0;
    if (!quiet) status.exceptions |= exception::invalid;
    return {Number::nan, false};
  }
  if (exponent == highest) return {Number::infinite, negative};
  if (exponent == 0) {
    if (fraction != 0) status.exceptions |= exception::denormal;
    return {Number::zero, negative};
  }
  return {Number::finite, negative, hidden | fraction, exponent - highest / 2 - fraction_bits};
}

Number double_of(std::uint64_t bits, DoubleStatus& status) {
  return number_of(bits, 11, 52, status);
}

Number invalid(DoubleStatus& status) {
  status.exceptions |= exception::invalid;
  return {Number::nan, false};
}

Number product_of(const Number& a, const Number& b, DoubleStatus& status) {
  const bool negative = a.negative != b.negative;
  // Infinity times zero counts even beside the NaN that a sum has then.
  if ((a.kind == Number::infinite && b.kind == Number::zero) ||
      (a.kind == Number::zero && b.kind == Number::infinite))
    return invalid(status);
  if (a.kind == Number::nan || b.kind == Number::nan) return {Number::nan, false};
  if (a.kind == Number::infinite || b.kind == Number::infinite) return {Number::infinite, negative};
  if (a.kind == Number::zero || b.kind == Number::zero) return {Number::zero, negative};
  return {Number::finite, negative, a.significand * b.significand, a.exponent + b.exponent};
}

struct Target {
  int exponent_bits, fraction_bits;
};
constexpr Target kSingle{8, 23}, kDouble{11, 52};

bool rounds_up(const Value& value, int last, Rounding rounding) {
  const bool half = value.bit(last - 1), more = value.has_bits_below(last - 1);
  switch (rounding) {
  case Rounding::nearest:
    return half && (more || value.bit(last));
  case Rounding::to_zero:
    return false;
  case Rounding::up:
    return (half || more) && !value.negative();
  case Rounding::down:
    return (half || more) && value.negative();
  }
  return false;
}

/// Infinity, or the largest number where the rounding is away from infinity.
std::uint64_t overflowed(bool negative, Rounding rounding, std::uint64_t infinity) {
  const bool to_infinity =
      rounding == Rounding::nearest || rounding == (negative ? Rounding::down : Rounding::up);
  return to_infinity ? infinity : infinity - 1;
}

/// Of a value that is not zero.
std::uint64_t rounded(const Value& value, const Target& target, DoubleStatus& status) {
  const int highest = (1 << target.exponent_bits) - 1;
  const int bias = highest / 2;
  const std::uint64_t infinity = static_cast<std::uint64_t>(highest) << target.fraction_bits;
  const std::uint64_t sign = static_cast<std::uint64_t>(value.negative())
                             << (target.exponent_bits + target.fraction_bits);
  int exponent = value.exponent();
  if (exponent + bias < 1) { // decided before rounding
    status.exceptions |= exception::underflow | exception::inexact;
    return sign;
  }
  const int last = exponent - target.fraction_bits;
  std::uint64_t significand = value.integer(last);
  if (value.has_bits_below(last)) status.exceptions |= exception::inexact;
  if (rounds_up(value, last, status.rounding)) ++significand;
  if (significand >> (target.fraction_bits + 1) != 0) {
    significand >>= 1;
    ++exponent;
  }
  if (exponent + bias >= highest) {
    status.exceptions |= exception::overflow | exception::inexact;
    return sign | overflowed(value.negative(), status.rounding, infinity);
  }
  const std::uint64_t hidden = std::uint64_t{1} << target.fraction_bits;
  return sign | static_cast<std::uint64_t>(exponent + bias) << target.fraction_bits |
         (significand & (hidden - 1));
}

std::uint64_t result_of(const Number& number, const Target& target, DoubleStatus& status) {
  const std::uint64_t sign = static_cast<std::uint64_t>(number.negative)
                             << (target.exponent_bits + target.fraction_bits);
  const std::uint64_t infinity = ((std::uint64_t{1} << target.exponent_bits) - 1) << target.fraction_bits;
  switch (number.kind) {
  case Number::zero:
    return sign;
  case Number::infinite:
    return sign | infinity;
  case Number::nan:
    return infinity | std::uint64_t{1} << (target.fraction_bits - 1);
  case Number::finite:
    break;
  }
  return rounded(Value::of(number.negative, number.significand, number.exponent), target, status);
}

std::uint64_t sum_of(const Number& a, const Number& b, DoubleStatus& status) {
  if (a.kind == Number::nan || b.kind == Number::nan) return kDefaultNan;
  if (a.kind == Number::infinite && b.kind == Number::infinite && a.negative != b.negative)
    return result_of(invalid(status), kDouble, status);
  if (a.kind == Number::infinite) return result_of(a, kDouble, status);
  if (b.kind == Number::infinite) return result_of(b, kDouble, status);
  const Value sum =
      Value::of(a.negative, a.significand, a.exponent) + Value::of(b.negative, b.significand, b.exponent);
  if (!sum.is_zero()) return rounded(sum, kDouble, status);
  const bool negative = a.kind == Number::zero && b.kind == Number::zero && a.negative == b.negative
                            ? a.negative
                            : status.rounding == Rounding::down;
  return negative ? kSign : 0;
}

Number negated(Number number) {
  number.negative = !number.negative;
  return number;
}

bool is_nan(std::uint64_t bits) {
  return (bits & ~kSign) > kInfinity;
}

/// Orders numbers as they are, zeros of both signs and denormals alike.
std::int64_t place_of(std::uint64_t bits) {
  const std::uint64_t magnitude = bits & ~kSign;
  if (magnitude >> 52 == 0) return 0;
  const auto place = static_cast<std::int64_t>(magnitude);
  return (bits & kSign) != 0 ? -place : place;
}

} // namespace

std::uint64_t double_add(std::uint64_t a, std::uint64_t b, DoubleStatus& status) {
  const Number x = double_of(a, status), y = double_of(b, status);
  return sum_of(x, y, status);
}

std::uint64_t double_subtract(std::uint64_t a, std::uint64_t b, DoubleStatus& status) {
  const Number x = double_of(a, status), y = double_of(b, status);
  return sum_of(x, negated(y), status);
}

std::uint64_t double_multiply(std::uint64_t a, std::uint64_t b, DoubleStatus& status) {
  const Number x = double_of(a, status), y = double_of(b, status);
  return result_of(product_of(x, y, status), kDouble, status);
}

std::uint64_t double_multiply_add(std::uint64_t a, std::uint64_t b, std::uint64_t c, bool subtract,
                                  DoubleStatus& status) {
  const Number x = double_of(a, status), y = double_of(b, status), z = double_of(c, status);
  return sum_of(product_of(x, y, status), subtract ? negated(z) : z, status);
}

std::uint64_t double_negate(std::uint64_t a) {
  return is_nan(a) ? a : a ^ kSign;
}

std::uint64_t double_from_single(std::uint32_t a, DoubleStatus& status) {
  return result_of(number_of(a, kSingle.exponent_bits, kSingle.fraction_bits, status), kDouble, status);
}

std::uint32_t double_to_single(std::uint64_t a, DoubleStatus& status) {
  return static_cast<std::uint32_t>(result_of(double_of(a, status), kSingle, status));
}

bool double_equal(std::uint64_t a, std::uint64_t b) {
  return !is_nan(a) && !is_nan(b) && place_of(a) == place_of(b);
}

bool double_greater(std::uint64_t a, std::uint64_t b) {
  return !is_nan(a) && !is_nan(b) && place_of(a) > place_of(b);
}

std::uint64_t double_magnitude(std::uint64_t a) {
  return a & ~kSign;
}

bool double_is_special(std::uint64_t a, std::uint32_t tests) {
  const std::uint64_t magnitude = a & ~kSign;
  if (is_nan(a)) return (tests & 0x40) != 0;
  const std::uint32_t of_sign = (a & kSign) != 0 ? tests : tests >> 1;
  if (magnitude == kInfinity) return (of_sign & 0x10) != 0;
  if (magnitude == 0) return (of_sign & 0x04) != 0;
  return magnitude >> 52 == 0 && (of_sign & 0x01) != 0;
}

} // namespace celltrace::test
