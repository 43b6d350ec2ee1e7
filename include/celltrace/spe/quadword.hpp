// A value of 128 bits with the SPU's numbering of its parts: part 0 is the most significant. Freestanding.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace celltrace::isa {

static_assert(std::endian::native == std::endian::little || std::endian::native == std::endian::big);

/// A register of 128 bits, stored as one integer of the host, so that every part is an integer in the host's
/// order: on a little-endian host the parts lie in reverse.
struct alignas(16) Quadword {
  std::uint8_t bytes[16];

  static constexpr bool kReversed = std::endian::native == std::endian::little;

  template <class Part> Part get(unsigned index) const {
    Part part;
    std::memcpy(&part, bytes + place<Part>(index), sizeof part);
    return part;
  }
  template <class Part> void set(unsigned index, Part part) {
    std::memcpy(bytes + place<Part>(index), &part, sizeof part);
  }

  std::uint8_t byte(unsigned index) const { return get<std::uint8_t>(index); }         ///< index 0..15
  std::uint16_t half(unsigned index) const { return get<std::uint16_t>(index); }       ///< index 0..7
  std::uint32_t word(unsigned index) const { return get<std::uint32_t>(index); }       ///< index 0..3
  std::uint64_t doubleword(unsigned index) const { return get<std::uint64_t>(index); } ///< index 0..1

  static Quadword zero() { return {}; }
  /// Returns a quadword with the same word in all four slots.
  static Quadword splat(std::uint32_t word) {
    Quadword q;
    for (unsigned i = 0; i < 4; ++i)
      q.set<std::uint32_t>(i, word);
    return q;
  }

  /// Load and store 16 bytes in the byte order of a real SPU's local store, big-endian.
  static Quadword load(const std::uint8_t* from) {
    Quadword q;
    std::memcpy(q.bytes, from, 16);
    if constexpr (kReversed) q.reverse();
    return q;
  }
  void store(std::uint8_t* to) const {
    Quadword q = *this;
    if constexpr (kReversed) q.reverse();
    std::memcpy(to, q.bytes, 16);
  }

  friend bool operator==(const Quadword& a, const Quadword& b) {
    return std::memcmp(a.bytes, b.bytes, sizeof a.bytes) == 0;
  }

private:
  template <class Part> static constexpr std::size_t place(unsigned index) {
    return kReversed ? 16 - (index + 1) * sizeof(Part) : index * sizeof(Part);
  }
  void reverse() {
    std::uint64_t halves[2];
    std::memcpy(halves, bytes, 16);
    const std::uint64_t swapped[2] = {__builtin_bswap64(halves[1]), __builtin_bswap64(halves[0])};
    std::memcpy(bytes, swapped, 16);
  }
};

} // namespace celltrace::isa
