// The floating-point status and control register. Source: SPU Instruction Set Architecture 1.2, chapter 9.
//
//   bits  20:21, 22:23   rounding of double precision in slots 0 and 1
//   bits  29:31, 61:63, 93:95, 125:127   exceptions of single precision in slots 0 to 3
//   bits  50:55, 82:87   exceptions of double precision in slots 0 and 1
//   bits  116:119        single-precision division by zero in slots 0 to 3
#pragma once

#include "celltrace/spe/quadword.hpp"

#include <cstdint>

namespace celltrace::isa {

namespace single_exception {
constexpr std::uint32_t overflow = 4, underflow = 2;
/// Set if IEEE arithmetic would have given another result.
constexpr std::uint32_t differs = 1;
} // namespace single_exception

namespace double_exception {
constexpr std::uint32_t overflow = 32 << 8, underflow = 16 << 8, inexact = 8 << 8, invalid = 4 << 8,
                        nan = 2 << 8, denormal = 1 << 8;
}

enum class Rounding : std::uint8_t { nearest, to_zero, up, down };

inline Rounding double_rounding(const Quadword& fpscr, unsigned slot) {
  return static_cast<Rounding>(fpscr.word(0) >> (slot == 0 ? 10 : 8) & 3);
}

inline void raise_in_word(Quadword& fpscr, unsigned word, std::uint32_t bits) {
  fpscr.set<std::uint32_t>(word, fpscr.word(word) | bits);
}
inline void raise_single(Quadword& fpscr, unsigned slot, std::uint32_t exceptions) {
  raise_in_word(fpscr, slot, exceptions);
}
inline void raise_division_by_zero(Quadword& fpscr, unsigned slot) {
  raise_in_word(fpscr, 3, 0x800u >> slot);
}
inline void raise_double(Quadword& fpscr, unsigned slot, std::uint32_t exceptions) {
  raise_in_word(fpscr, 1 + slot, exceptions);
}

} // namespace celltrace::isa
