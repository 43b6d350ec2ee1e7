// Local store in flight, as an SPU could touch it: past the address sanitizer, which the emulator tells to
// forbid just that.
#pragma once

#include <cstdint>

namespace celltrace::test {

/// What a program finds where data are still to come.
constexpr std::uint32_t kPoisonWord = 0x7FB5DEAD;
/// What lies where nobody has written, such as in the stack of host code.
constexpr std::uint32_t kUnwrittenWord = 0x7FB0DEAD;

[[gnu::noinline, gnu::no_sanitize_address]] inline std::uint32_t peek(const std::uint32_t* word) {
  return *const_cast<const volatile std::uint32_t*>(word);
}

[[gnu::noinline, gnu::no_sanitize_address]] inline void poke(std::uint32_t* word, std::uint32_t value) {
  *const_cast<volatile std::uint32_t*>(word) = value;
}

} // namespace celltrace::test
