// Arithmetic of the SPU's single precision. Numbers have an extended range: the exponent 255 is ordinary, and
// there is neither infinity nor NaN. Denormal operands count as zero, results are truncated; results that are
// too small and all zeros are +0, results that are too large become the largest number. Source: SPU
// Instruction Set Architecture 1.2, chapter 9.
//
// A double holds each such number and each product of two such numbers exactly. Sums are computed in doubles,
// rounded to nearest, and corrected towards zero by the sign of the rounding error (Knuth's TwoSum). Because
// a double has more than 24 bits, cutting it to 24 bits then gives the truncated exact result.
//
// Two numbers are processed at once, without branches, with the vectors of GCC and Clang: the interpreter
// spends most of a renderer's time here, and compilers do not vectorise loops over single numbers.
#pragma once

#include <bit>
#include <cstdint>

namespace celltrace::isa {

using Doubles [[gnu::vector_size(16)]] = double;
using Bits [[gnu::vector_size(16)]] = std::uint64_t;

constexpr double kSmallestSingle = 0x1p-126;
constexpr double kLargestSingle = 0x1.fffffep+128;

/// Number of bits that a double's fraction has more than a single's; the difference of the exponents' biases.
constexpr unsigned kExtraFraction = 29;
constexpr std::uint64_t kExtraBias = std::uint64_t{1023 - 127} << 52;
constexpr std::uint64_t kDoubleSign = std::uint64_t{1} << 63;

inline Bits bits_of(Doubles x) {
  return std::bit_cast<Bits>(x);
}
inline Doubles doubles_of(Bits bits) {
  return std::bit_cast<Doubles>(bits);
}
inline Doubles magnitude(Doubles x) {
  return doubles_of(bits_of(x) & ~kDoubleSign);
}
/// Returns ones in the lanes where a comparison holds, zeros in the others.
template <class Comparison> Bits mask_of_lanes(Comparison comparison) {
  return std::bit_cast<Bits>(comparison);
}

/// Converts singles in the lower halves of lanes to doubles, exactly; denormals become zeros. The upper
/// halves of the lanes must be zero.
inline Doubles from_single(Bits words) {
  const Bits bits = ((words & 0x7FFFFFFF) << kExtraFraction) + kExtraBias;
  const Bits sign = (words & 0x80000000) << 32;
  return doubles_of((bits & mask_of_lanes(doubles_of(bits) >= kSmallestSingle)) | sign);
}

/// Converts doubles to singles, by cutting to 24 bits. The doubles must not be greater than the largest
/// single.
inline Bits to_single_in_range(Doubles x) {
  const Doubles whole = magnitude(x);
  const Bits bits = (bits_of(whole) - kExtraBias) >> kExtraFraction;
  const Bits sign = (bits_of(x) & kDoubleSign) >> 32;
  return (bits | sign) & mask_of_lanes(whole >= kSmallestSingle);
}
/// Converts doubles to singles, by cutting to 24 bits; greater numbers become the largest single.
inline Bits to_single(Doubles x) {
  const Bits too_large = mask_of_lanes(magnitude(x) > kLargestSingle);
  const Bits largest = bits_of(Doubles{kLargestSingle, kLargestSingle}) | (bits_of(x) & kDoubleSign);
  return to_single_in_range(doubles_of((largest & too_large) | (bits_of(x) & ~too_large)));
}

/// Returns x + y, rounded to the next double towards zero.
inline Doubles sum_towards_zero(Doubles x, Doubles y) {
  const Doubles sum = x + y;
  const Doubles part = sum - x;
  const Doubles error = (x - (sum - part)) + (y - part);
  return doubles_of(bits_of(sum) + mask_of_lanes(error * sum < 0.0)); // the mask is -1
}

/// Returns ones for numbers that are not 0 but become 0 as singles.
inline Bits underflow_mask(Doubles x) {
  const Doubles whole = magnitude(x);
  return mask_of_lanes(whole > 0.0) & mask_of_lanes(whole < kSmallestSingle);
}
/// Returns ones for numbers whose magnitude is at least `bound`.
inline Bits reaches_mask(Doubles x, double bound) {
  return mask_of_lanes(magnitude(x) >= bound);
}

/// Returns ones in the words of operands that IEEE interprets differently: denormals, and numbers with the
/// exponent 255.
inline Bits differs_mask(Bits words) {
  using Words [[gnu::vector_size(16)]] = std::int32_t;
  const auto rest = std::bit_cast<Words>(words & 0x7FFFFFFF7FFFFFFF);
  return mask_of_lanes(rest > 0x7F7FFFFF) | (mask_of_lanes(rest > 0) & mask_of_lanes(rest < 0x00800000));
}

/// Returns an integer for compares: integers of two words are ordered as the words' numbers.
constexpr std::int32_t ordered(std::uint32_t word) {
  const auto rest = static_cast<std::int32_t>(word & 0x7FFFFFFF);
  const std::int32_t flushed = rest < 0x00800000 ? 0 : rest;
  return (word & 0x80000000) != 0 ? -flushed : flushed;
}
constexpr std::int32_t ordered_magnitude(std::uint32_t word) {
  return ordered(word & 0x7FFFFFFF);
}

} // namespace celltrace::isa
