// Fill patterns and checksums, by which the emulator finds out whether a program touched local store that it
// must not touch, such as the target of a transfer in flight.
#pragma once

#include <cstdint>
#include <optional>

namespace celltrace::cell_emu {

/// Returns a checksum of `bytes` bytes.
std::uint64_t checksum(const std::uint8_t* at, std::uint32_t bytes);

/// Fills bytes with the pattern of unused local store: words of 0x7FB0DEAD, a NaN.
void fill_with_poison(std::uint8_t* at, std::uint32_t bytes);
bool is_poison(const std::uint8_t* at, std::uint32_t bytes);

/// Fills bytes with the pattern of data that a get has yet to deliver: words of 0x7FB5DEAD. As a float, this
/// word is a signalling NaN: copies keep it, and the host's arithmetic turns it into 0x7FF5DEAD, which
/// further arithmetic keeps.
void fill_as_in_flight(std::uint8_t* at, std::uint32_t bytes);
bool is_as_in_flight(const std::uint8_t* at, std::uint32_t bytes);
/// Returns the offset of the first word that is 0x7FB5DEAD or 0x7FF5DEAD; nothing if there is none. The
/// negatives of these floats are ignored, because they are also opaque pixels of a light green.
std::optional<std::uint32_t> find_in_flight_word(const std::uint8_t* at, std::uint32_t bytes);

} // namespace celltrace::cell_emu
