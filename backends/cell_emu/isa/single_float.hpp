// Arithmetic of the SPU's single precision. Numbers have an extended range: the exponent 255 is an ordinary
// one, and there is neither infinity nor NaN. Denormal operands count as zero, results are truncated, those
// too small and all zeros are +0, those too large the largest number. Source: SPU Instruction Set
// Architecture 1.2, chapter 9.
//
// A double holds each such number exactly, each product of two, and more than a sum's 24 bits. Sums and
// products are therefore done in doubles, rounded to nearest, and corrected towards zero by the sign of the
// rounding error (Knuth's TwoSum); cutting that to 24 bits is the truncation of the exact result. No
// branches: compilers vectorise it.
#pragma once

#include <bit>
#include <cstdint>

namespace celltrace::isa {

constexpr double kSmallestSingle = 0x1p-126;
constexpr double kLargestSingle = 0x1.fffffep+128;

/// Bits of a double below those of a single, and the difference of their exponents' biases.
constexpr unsigned kExtraFraction = 29;
constexpr std::uint64_t kExtraBias = std::uint64_t{1023 - 127} << 52;
constexpr std::uint64_t kDoubleSign = std::uint64_t{1} << 63;

constexpr double magnitude(double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & ~kDoubleSign);
}

/// The number that a word is, exactly; a denormal is zero.
constexpr double from_single(std::uint32_t word) {
  const auto bits = (static_cast<std::uint64_t>(word & 0x7FFFFFFF) << kExtraFraction) + kExtraBias;
  const double positive = std::bit_cast<double>(bits);
  const double flushed = positive >= kSmallestSingle ? positive : 0.0;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(flushed) |
                               static_cast<std::uint64_t>(word & 0x80000000) << 32);
}

/// Cut to 24 bits.
constexpr std::uint32_t to_single(double x) {
  const double whole = magnitude(x);
  const double limited = whole > kLargestSingle ? kLargestSingle : whole;
  const std::uint64_t bits = (std::bit_cast<std::uint64_t>(limited) - kExtraBias) >> kExtraFraction;
  const std::uint64_t sign = (std::bit_cast<std::uint64_t>(x) & kDoubleSign) >> 32;
  return static_cast<std::uint32_t>(whole >= kSmallestSingle ? bits | sign : 0);
}

/// x + y, rounded to the next double towards zero.
constexpr double sum_towards_zero(double x, double y) {
  const double sum = x + y;
  const double part = sum - x;
  const double error = (x - (sum - part)) + (y - part);
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(sum);
  return std::bit_cast<double>(error * sum < 0 ? bits - 1 : bits);
}

/// Whether IEEE takes an operand or a result as something else, a denormal or with the exponent 255: ones or
/// zeros.
constexpr std::uint32_t differs_mask(std::uint32_t word) {
  const auto rest = static_cast<std::int32_t>(word & 0x7FFFFFFF);
  const bool denormal = rest > 0 && rest < 0x00800000, extended = rest >= 0x7F800000;
  return (denormal ? ~0u : 0) | (extended ? ~0u : 0);
}
/// Whether a result became zero that is not.
constexpr std::uint32_t underflow_mask(double x) {
  return magnitude(x) > 0 && magnitude(x) < kSmallestSingle ? ~0u : 0;
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
