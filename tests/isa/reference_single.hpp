// Single precision of the SPU by integers: extended range, no infinity and no NaN, denormals are zeros,
// results are truncated, zeros are +0, overflow gives the largest number. Source: SPU Instruction Set
// Architecture 1.2, chapter 9. Values are the 32 bits of a number.
#pragma once

#include <cstdint>

namespace celltrace::test {

/// Exceptions, as the three bits of a slot in the FPSCR.
namespace single_exception {
constexpr std::uint32_t overflow = 4, underflow = 2;
/// An operand or the result is none of IEEE's normal numbers.
constexpr std::uint32_t differs = 1;
} // namespace single_exception

/// a * b + c, rounded once; the signs of the product and of c may be turned before. These add to the
/// exceptions.
std::uint32_t single_multiply_add(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool negate_product,
                                  bool negate_c, std::uint32_t& exceptions);
std::uint32_t single_add(std::uint32_t a, std::uint32_t b, std::uint32_t& exceptions);
std::uint32_t single_subtract(std::uint32_t a, std::uint32_t b, std::uint32_t& exceptions);
std::uint32_t single_multiply(std::uint32_t a, std::uint32_t b, std::uint32_t& exceptions);

bool single_equal(std::uint32_t a, std::uint32_t b);
bool single_greater(std::uint32_t a, std::uint32_t b);
/// Without the sign.
std::uint32_t single_magnitude(std::uint32_t a);

/// value * 2^exponent.
std::uint32_t single_from_integer(std::int64_t value, int exponent, std::uint32_t& exceptions);
/// a * 2^exponent, truncated, kept between the ends of the integers of 32 bits.
std::uint32_t single_to_signed(std::uint32_t a, int exponent);
std::uint32_t single_to_unsigned(std::uint32_t a, int exponent);

/// What has no reciprocal.
bool single_is_zero(std::uint32_t a);
/// Sign, exponent, 13 bits of base and 10 bits of step. Source: recorded on a PlayStation 3.
std::uint32_t reciprocal_estimate(std::uint32_t a);
std::uint32_t reciprocal_square_root_estimate(std::uint32_t a);
/// fi: the line of an estimate, at the place of `a` in it.
std::uint32_t interpolate(std::uint32_t a, std::uint32_t estimate);

} // namespace celltrace::test
