// Register fields of an instruction word; RRR has its target elsewhere, and rc where the others have rt.
#pragma once

#include <cstdint>

namespace celltrace::test {

constexpr unsigned rt_of(std::uint32_t word) {
  return word & 0x7F;
}
constexpr unsigned rc_of(std::uint32_t word) {
  return word & 0x7F;
}
constexpr unsigned ra_of(std::uint32_t word) {
  return word >> 7 & 0x7F;
}
constexpr unsigned rb_of(std::uint32_t word) {
  return word >> 14 & 0x7F;
}

} // namespace celltrace::test
