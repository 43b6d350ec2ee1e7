// What tells whether a program touched local store that a transfer in flight uses: poison, checksums and, in
// builds with the address sanitizer, its shadow memory.
#pragma once

#include <cstddef>
#include <cstdint>

namespace celltrace::cell_emu {

/// A checksum of `bytes` bytes.
std::uint64_t checksum(const std::uint8_t* at, std::uint32_t bytes);

/// Fills with the pattern that a program finds where data are still to come: words of 0x7FB0DEAD, a NaN.
void fill_with_poison(std::uint8_t* at, std::uint32_t bytes);
bool is_poison(const std::uint8_t* at, std::uint32_t bytes);

/// Makes the address sanitizer, if the build has it, report every access of the program.
void forbid_access(const std::uint8_t* at, std::uint32_t bytes);
void permit_access(const std::uint8_t* at, std::size_t bytes);
/// Nothing there is forbidden.
bool may_access(const std::uint8_t* at, std::uint32_t bytes);

} // namespace celltrace::cell_emu
