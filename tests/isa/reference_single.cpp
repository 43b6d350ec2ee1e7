#include "isa/reference_single.hpp"

#include "isa/exact.hpp"

#include <algorithm>

namespace celltrace::test {

namespace {

constexpr int kBias = 127;
constexpr int kFractionBits = 23;
constexpr std::uint32_t kSign = 0x80000000;

/// From the last bit of the smallest product, 2^-298, to the largest number that is scaled to an integer,
/// 2^302.
using Value = Exact<10, -298>;

struct Number {
  bool negative;
  std::uint32_t significand; ///< 24 bits, or zero
  int exponent;              ///< of its last bit
};

int exponent_field(std::uint32_t bits) {
  return static_cast<int>(bits >> kFractionBits & 0xFF);
}

Number number_of(std::uint32_t bits) {
  const bool negative = (bits & kSign) != 0;
  const int exponent = exponent_field(bits);
  if (exponent == 0) return {negative, 0, 0};
  const std::uint32_t significand = (1u << kFractionBits) | (bits & ((1u << kFractionBits) - 1));
  return {negative, significand, exponent - kBias - kFractionBits};
}

Number operand(std::uint32_t bits, std::uint32_t& exceptions) {
  const bool denormal = exponent_field(bits) == 0 && (bits & ~kSign) != 0;
  if (denormal || exponent_field(bits) == 255) exceptions |= single_exception::differs;
  return number_of(bits);
}

Value value_of(const Number& number) {
  return Value::of(number.negative, number.significand, number.exponent);
}

std::uint32_t truncated(const Value& value, std::uint32_t& exceptions) {
  if (value.is_zero()) return 0;
  const int exponent = value.exponent();
  if (exponent + kBias < 1) {
    exceptions |= single_exception::underflow | single_exception::differs;
    return 0;
  }
  const std::uint32_t sign = value.negative() ? kSign : 0;
  if (exponent + kBias >= 255) exceptions |= single_exception::differs;
  if (exponent + kBias > 255) {
    exceptions |= single_exception::overflow;
    return sign | 0x7FFFFFFF;
  }
  const auto significand = static_cast<std::uint32_t>(value.integer(exponent - kFractionBits));
  return sign | static_cast<std::uint32_t>(exponent + kBias) << kFractionBits |
         (significand & ((1u << kFractionBits) - 1));
}

/// Orders numbers as they are, zeros of both signs and denormals alike.
std::int64_t place_of(std::uint32_t bits) {
  const std::uint32_t magnitude = bits & ~kSign;
  if (magnitude >> kFractionBits == 0) return 0;
  return (bits & kSign) != 0 ? -std::int64_t{magnitude} : std::int64_t{magnitude};
}

// The low 23 bits of frest, by the upper five bits of the fraction; those of frsqest, by the exponent's last
// bit and the same five.
constexpr std::uint32_t kReciprocal[32] = {
    0x7FFBE0, 0x7F87A6, 0x70EF72, 0x708B40, 0x638B12, 0x633AEA, 0x5792C4, 0x574AA0,
    0x4CCA7E, 0x4C9262, 0x430A44, 0x42D62A, 0x3A2E12, 0x39FDFA, 0x3215E4, 0x31F1D2,
    0x2AA9BE, 0x2A85AC, 0x23D59A, 0x23BD8E, 0x1D8576, 0x1D8576, 0x17AD5A, 0x17AD5A,
    0x124543, 0x124543, 0x0D392D, 0x0D392D, 0x08851A, 0x08851A, 0x041D07, 0x041D07};
constexpr std::uint32_t kReciprocalSquareRoot[64] = {
    0x350160, 0x34E954, 0x2F993D, 0x2F993D, 0x2AA523, 0x2AA523, 0x26190D, 0x26190D, 0x21E4F9, 0x21E4F9,
    0x1E00E9, 0x1E00E9, 0x1A5CD9, 0x1A5CD9, 0x16F8CB, 0x16F8CB, 0x13CCC0, 0x13CCC0, 0x10CCB3, 0x10CCB3,
    0x0E00AA, 0x0E00AA, 0x0B58A1, 0x0B58A1, 0x08D498, 0x08D498, 0x067491, 0x067491, 0x043089, 0x043089,
    0x020C83, 0x020C83, 0x7FFDF4, 0x7FD1DE, 0x7859C8, 0x783DBA, 0x71559C, 0x71559C, 0x6AE57C, 0x6AE57C,
    0x64F561, 0x64F561, 0x5F7149, 0x5F7149, 0x5A4D33, 0x5A4D33, 0x55811F, 0x55811F, 0x51050F, 0x51050F,
    0x4CC8FE, 0x4CC8FE, 0x48D0F0, 0x48D0F0, 0x4510E4, 0x4510E4, 0x4180D7, 0x4180D7, 0x3E24CC, 0x3E24CC,
    0x3AF4C3, 0x3AF4C3, 0x37E8BA, 0x37E8BA};

} // namespace

std::uint32_t single_multiply_add(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool negate_product,
                                  bool negate_c, std::uint32_t& exceptions) {
  const Number x = operand(a, exceptions), y = operand(b, exceptions);
  const Number z = operand(negate_c ? c ^ kSign : c, exceptions);
  const Value product = Value::of((x.negative != y.negative) != negate_product,
                                  Wide{x.significand} * y.significand, x.exponent + y.exponent);
  return truncated(product + value_of(z), exceptions);
}

std::uint32_t single_add(std::uint32_t a, std::uint32_t b, std::uint32_t& exceptions) {
  return truncated(value_of(operand(a, exceptions)) + value_of(operand(b, exceptions)), exceptions);
}

std::uint32_t single_subtract(std::uint32_t a, std::uint32_t b, std::uint32_t& exceptions) {
  return single_add(a, b ^ kSign, exceptions);
}

std::uint32_t single_multiply(std::uint32_t a, std::uint32_t b, std::uint32_t& exceptions) {
  return single_multiply_add(a, b, 0, false, false, exceptions);
}

bool single_equal(std::uint32_t a, std::uint32_t b) {
  return place_of(a) == place_of(b);
}

bool single_greater(std::uint32_t a, std::uint32_t b) {
  return place_of(a) > place_of(b);
}

std::uint32_t single_magnitude(std::uint32_t a) {
  return a & ~kSign;
}

std::uint32_t single_from_integer(std::int64_t value, int exponent, std::uint32_t& exceptions) {
  const auto magnitude = static_cast<Wide>(value < 0 ? -value : value);
  return truncated(Value::of(value < 0, magnitude, exponent), exceptions);
}

std::uint32_t single_to_signed(std::uint32_t a, int exponent) {
  const Number number = number_of(a);
  const Value value = Value::of(number.negative, number.significand, number.exponent + exponent);
  if (value.exponent() >= 31) return number.negative ? 0x80000000 : 0x7FFFFFFF;
  const auto magnitude = static_cast<std::uint32_t>(value.integer(0));
  return number.negative ? 0 - magnitude : magnitude;
}

std::uint32_t single_to_unsigned(std::uint32_t a, int exponent) {
  const Number number = number_of(a);
  if (number.negative) return 0;
  const Value value = Value::of(false, number.significand, number.exponent + exponent);
  return value.exponent() >= 32 ? 0xFFFFFFFF : static_cast<std::uint32_t>(value.integer(0));
}

bool single_is_zero(std::uint32_t a) {
  return exponent_field(a) == 0;
}

std::uint32_t reciprocal_estimate(std::uint32_t a) {
  const int exponent = exponent_field(a);
  const int estimated = exponent == 0 ? 0xFF : std::max(0, 253 - exponent);
  return (a & kSign) | static_cast<std::uint32_t>(estimated) << 23 | kReciprocal[a >> 18 & 31];
}

std::uint32_t reciprocal_square_root_estimate(std::uint32_t a) {
  const int exponent = exponent_field(a);
  const int estimated = exponent == 0 ? 0xFF : 190 - (exponent + 1) / 2;
  return static_cast<std::uint32_t>(estimated) << 23 | kReciprocalSquareRoot[a >> 18 & 63];
}

std::uint32_t interpolate(std::uint32_t a, std::uint32_t estimate) {
  // Base and step in units of 2^-13, the place of a in units of 2^-19; their line in units of 2^-32.
  const std::int64_t base = 0x2000 + (estimate >> 10 & 0x1FFF);
  const std::int64_t step = estimate & 0x3FF;
  const std::int64_t place = a & 0x7FFFF;
  const std::int64_t line = (base << 19) - step * place;
  const bool below_one = line < std::int64_t{1} << 32;
  const int exponent = exponent_field(estimate) - (below_one ? 1 : 0);
  if (exponent <= 0) return 0;
  const auto fraction = static_cast<std::uint32_t>(line >> (below_one ? 8 : 9)) & 0x7FFFFF;
  return (estimate & kSign) | static_cast<std::uint32_t>(exponent) << 23 | fraction;
}

} // namespace celltrace::test
