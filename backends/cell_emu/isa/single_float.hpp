// Arithmetic of the SPU's single precision. Numbers have an extended range: the exponent 255 is an ordinary
// one, and there is neither infinity nor NaN. Denormal operands count as zero, results are truncated, those
// too small and all zeros are +0, those too large the largest number. Source: SPU Instruction Set
// Architecture 1.2, chapter 9.
//
// A double holds each such number exactly, each product of two, and more than a sum's 24 bits. Sums and
// products are therefore done in doubles, rounded to nearest, and corrected towards zero by the sign of the
// rounding error (Knuth's TwoSum); cutting that to 24 bits is the truncation of the exact result.
//
// Two numbers are worked on at once, without branches, with the vectors of GCC and Clang: an interpreter
// spends most of a renderer's time here, and compilers do not vectorise the same loops over numbers.
#pragma once

#include <bit>
#include <cstdint>

namespace celltrace::isa {

using Doubles [[gnu::vector_size(16)]] = double;
using Bits [[gnu::vector_size(16)]] = std::uint64_t;

constexpr double kSmallestSingle = 0x1p-126;
constexpr double kLargestSingle = 0x1.fffffep+128;

/// Bits of a double below those of a single, and the difference of their exponents' biases.
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
/// Ones where a comparison holds, zeros elsewhere.
template <class Comparison> Bits mask_of_lanes(Comparison comparison) {
  return std::bit_cast<Bits>(comparison);
}

/// The numbers that words are, exactly; denormals are zeros. The upper halves of the lanes are zero.
inline Doubles from_single(Bits words) {
  const Bits bits = ((words & 0x7FFFFFFF) << kExtraFraction) + kExtraBias;
  const Bits sign = (words & 0x80000000) << 32;
  return doubles_of((bits & mask_of_lanes(doubles_of(bits) >= kSmallestSingle)) | sign);
}

/// Cut to 24 bits; no more than the largest single.
inline Bits to_single_in_range(Doubles x) {
  const Doubles whole = magnitude(x);
  const Bits bits = (bits_of(whole) - kExtraBias) >> kExtraFraction;
  const Bits sign = (bits_of(x) & kDoubleSign) >> 32;
  return (bits | sign) & mask_of_lanes(whole >= kSmallestSingle);
}
/// Cut to 24 bits.
inline Bits to_single(Doubles x) {
  const Bits too_large = mask_of_lanes(magnitude(x) > kLargestSingle);
  const Bits largest = bits_of(Doubles{kLargestSingle, kLargestSingle}) | (bits_of(x) & kDoubleSign);
  return to_single_in_range(doubles_of((largest & too_large) | (bits_of(x) & ~too_large)));
}

/// x + y, rounded to the next double towards zero.
inline Doubles sum_towards_zero(Doubles x, Doubles y) {
  const Doubles sum = x + y;
  const Doubles part = sum - x;
  const Doubles error = (x - (sum - part)) + (y - part);
  return doubles_of(bits_of(sum) + mask_of_lanes(error * sum < 0.0)); // the mask is -1
}

/// Ones for results that become zero without being it.
inline Bits underflow_mask(Doubles x) {
  const Doubles whole = magnitude(x);
  return mask_of_lanes(whole > 0.0) & mask_of_lanes(whole < kSmallestSingle);
}
/// Ones for those of at least that magnitude.
inline Bits reaches_mask(Doubles x, double bound) {
  return mask_of_lanes(magnitude(x) >= bound);
}

/// Whether IEEE takes an operand as something else, a denormal or with the exponent 255: ones in its word.
inline Bits differs_mask(Bits words) {
  using Words [[gnu::vector_size(16)]] = std::int32_t;
  const auto rest = std::bit_cast<Words>(words & 0x7FFFFFFF7FFFFFFF);
  return mask_of_lanes(rest > 0x7F7FFFFF) | (mask_of_lanes(rest > 0) & mask_of_lanes(rest < 0x00800000));
}

/// For compares: as an integer, in the order of the numbers.
constexpr std::int32_t ordered(std::uint32_t word) {
  const auto rest = static_cast<std::int32_t>(word & 0x7FFFFFFF);
  const std::int32_t flushed = rest < 0x00800000 ? 0 : rest;
  return (word & 0x80000000) != 0 ? -flushed : flushed;
}
constexpr std::int32_t ordered_magnitude(std::uint32_t word) {
  return ordered(word & 0x7FFFFFFF);
}

} // namespace celltrace::isa
