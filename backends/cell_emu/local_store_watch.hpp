// Poison and checksums, which tell whether a program touched local store that a transfer in flight uses.
#pragma once

#include <cstdint>
#include <optional>

namespace celltrace::cell_emu {

/// A checksum of `bytes` bytes.
std::uint64_t checksum(const std::uint8_t* at, std::uint32_t bytes);

/// Fills with the pattern of local store that is nobody's: words of 0x7FB0DEAD, a NaN.
void fill_with_poison(std::uint8_t* at, std::uint32_t bytes);
bool is_poison(const std::uint8_t* at, std::uint32_t bytes);

/// Fills with the pattern that a program finds where data are still to come: words of 0x7FB5DEAD. As a float
/// that is a signalling NaN: it stays as it is where it is copied, and a processor's arithmetic makes
/// 0x7FF5DEAD of it, which arithmetic hands on.
void fill_as_in_flight(std::uint8_t* at, std::uint32_t bytes);
bool is_as_in_flight(const std::uint8_t* at, std::uint32_t bytes);
/// Returns the offset of the first of either word among whole words of 4 bytes. Their negatives do not count:
/// these are opaque pixels of a light green, too.
std::optional<std::uint32_t> find_in_flight_word(const std::uint8_t* at, std::uint32_t bytes);

} // namespace celltrace::cell_emu
