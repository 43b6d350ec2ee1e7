// Poison and checksums, which show whether a program touched local store that a transfer in flight uses.
#pragma once

#include <cstdint>
#include <optional>

namespace celltrace::cell_emu {

/// Returns a checksum of `bytes` bytes.
std::uint64_t checksum(const std::uint8_t* at, std::uint32_t bytes);

/// Fills bytes with the pattern of unused local store: words of 0x7FB0DEAD, a NaN.
void fill_with_poison(std::uint8_t* at, std::uint32_t bytes);
bool is_poison(const std::uint8_t* at, std::uint32_t bytes);

/// Fills bytes with the pattern that stands for data still to come: words of 0x7FB5DEAD. As a float
/// this is a signalling NaN: copies keep it, and the processor's arithmetic turns it into
/// 0x7FF5DEAD, which further arithmetic keeps.
void fill_as_in_flight(std::uint8_t* at, std::uint32_t bytes);
bool is_as_in_flight(const std::uint8_t* at, std::uint32_t bytes);
/// Returns the offset of the first of either word among whole words of 4 bytes. Their negatives are ignored,
/// because they are also opaque pixels of a light green.
std::optional<std::uint32_t> find_in_flight_word(const std::uint8_t* at, std::uint32_t bytes);

} // namespace celltrace::cell_emu
