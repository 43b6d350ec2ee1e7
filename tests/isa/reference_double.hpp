// Double precision of the SPU by integers: IEEE 754 with four rounding modes, denormal operands and results
// are zeros of their sign, every NaN result is the default one. Source: SPU Instruction Set Architecture 1.2,
// chapter
// 9. Values are the bits of a number.
#pragma once

#include <cstdint>

namespace celltrace::test {

/// As the FPSCR numbers them.
enum class Rounding : std::uint8_t { nearest, to_zero, up, down };

/// Exceptions, as the six bits of a slot in the FPSCR.
namespace exception {
constexpr std::uint32_t overflow = 32, underflow = 16, inexact = 8, invalid = 4, nan = 2, denormal = 1;
}

/// What an operation is done by and leaves behind.
struct DoubleStatus {
  Rounding rounding = Rounding::nearest;
  std::uint32_t exceptions = 0;
};

std::uint64_t double_add(std::uint64_t a, std::uint64_t b, DoubleStatus& status);
std::uint64_t double_subtract(std::uint64_t a, std::uint64_t b, DoubleStatus& status);
std::uint64_t double_multiply(std::uint64_t a, std::uint64_t b, DoubleStatus& status);
/// a * b + c, or a * b - c, rounded once.
std::uint64_t double_multiply_add(std::uint64_t a, std::uint64_t b, std::uint64_t c, bool subtract,
                                  DoubleStatus& status);
/// Any number but a NaN with its sign turned.
std::uint64_t double_negate(std::uint64_t a);

/// Single precision is IEEE's in these two: exponent 255 is infinity and NaN.
std::uint64_t double_from_single(std::uint32_t a, DoubleStatus& status);
std::uint32_t double_to_single(std::uint64_t a, DoubleStatus& status);

/// False if either is a NaN.
bool double_equal(std::uint64_t a, std::uint64_t b);
bool double_greater(std::uint64_t a, std::uint64_t b);
std::uint64_t double_magnitude(std::uint64_t a);

/// dftsv; the bits of `tests` from the highest: NaN, infinities, zeros, denormals, of each the positive
/// first.
bool double_is_special(std::uint64_t a, std::uint32_t tests);

} // namespace celltrace::test
