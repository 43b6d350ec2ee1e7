// The SPU's estimates of reciprocals (frest, frsqest), and the interpolation (fi) that refines an estimate.
// An estimate has the layout of a single, but its fraction holds 13 bits of a base and 10 bits of a slope:
// they define a line that approximates the function in an interval of x. Source: results recorded on a
// PlayStation 3, in tests/isa/estimates.inc.
#pragma once

#include <array>
#include <cstdint>

namespace celltrace::isa {

inline constexpr std::array<std::uint32_t, 32> kReciprocalTable = {
    0x7FFBE0, 0x7F87A6, 0x70EF72, 0x708B40, 0x638B12, 0x633AEA, 0x5792C4, 0x574AA0,
    0x4CCA7E, 0x4C9262, 0x430A44, 0x42D62A, 0x3A2E12, 0x39FDFA, 0x3215E4, 0x31F1D2,
    0x2AA9BE, 0x2A85AC, 0x23D59A, 0x23BD8E, 0x1D8576, 0x1D8576, 0x17AD5A, 0x17AD5A,
    0x124543, 0x124543, 0x0D392D, 0x0D392D, 0x08851A, 0x08851A, 0x041D07, 0x041D07,
};

/// The first half is for even exponents, the second half for odd ones.
inline constexpr std::array<std::uint32_t, 64> kReciprocalSquareRootTable = {
    0x350160, 0x34E954, 0x2F993D, 0x2F993D, 0x2AA523, 0x2AA523, 0x26190D, 0x26190D, 0x21E4F9, 0x21E4F9,
    0x1E00E9, 0x1E00E9, 0x1A5CD9, 0x1A5CD9, 0x16F8CB, 0x16F8CB, 0x13CCC0, 0x13CCC0, 0x10CCB3, 0x10CCB3,
    0x0E00AA, 0x0E00AA, 0x0B58A1, 0x0B58A1, 0x08D498, 0x08D498, 0x067491, 0x067491, 0x043089, 0x043089,
    0x020C83, 0x020C83, 0x7FFDF4, 0x7FD1DE, 0x7859C8, 0x783DBA, 0x71559C, 0x71559C, 0x6AE57C, 0x6AE57C,
    0x64F561, 0x64F561, 0x5F7149, 0x5F7149, 0x5A4D33, 0x5A4D33, 0x55811F, 0x55811F, 0x51050F, 0x51050F,
    0x4CC8FE, 0x4CC8FE, 0x48D0F0, 0x48D0F0, 0x4510E4, 0x4510E4, 0x4180D7, 0x4180D7, 0x3E24CC, 0x3E24CC,
    0x3AF4C3, 0x3AF4C3, 0x37E8BA, 0x37E8BA,
};

constexpr std::uint32_t reciprocal_estimate(std::uint32_t x) {
  const std::uint32_t exponent = x >> 23 & 0xFF;
  const std::uint32_t reversed = exponent == 0 ? 255 : exponent > 253 ? 0 : 253 - exponent;
  return (x & 0x80000000) | reversed << 23 | kReciprocalTable[x >> 18 & 31];
}

constexpr std::uint32_t reciprocal_square_root_estimate(std::uint32_t x) {
  const std::uint32_t exponent = x >> 23 & 0xFF;
  const std::uint32_t halved = exponent == 0 ? 255 : 190 - (exponent + 1) / 2;
  return halved << 23 | kReciprocalSquareRootTable[x >> 18 & 63];
}

/// Returns the value at x of the line that `estimate` encodes: (1.base - 0.000step * 0.y) * 2^exponent.
constexpr std::uint32_t interpolate(std::uint32_t x, std::uint32_t estimate) {
  const std::uint64_t base = 0x2000 + (estimate >> 10 & 0x1FFF); // 1.base, 13 bits behind the point
  const std::uint64_t step = estimate & 0x3FF;                   // 13 bits behind the point
  const std::uint64_t y = x & 0x7FFFF;                           // 19 bits
  const std::uint64_t value = (base << 19) - step * y;           // 32 bits, between 0.875 and 2
  const std::uint32_t exponent = estimate >> 23 & 0xFF;
  const std::uint32_t below_one = value >> 32 == 0 ? 1 : 0;
  if (exponent <= below_one) return 0;
  const auto fraction = static_cast<std::uint32_t>((value << below_one) >> 9) & 0x7FFFFF;
  return (estimate & 0x80000000) | (exponent - below_one) << 23 | fraction;
}

} // namespace celltrace::isa
