// The file format of cache traces, shared by its writer and its reader: a head, then chunks, each a few
// numbers and words of one cache. All numbers are 32 bits, little-endian.
#pragma once

#include "celltrace/cache/trace_words.hpp"

#include <array>
#include <cstdint>

namespace celltrace::cache_trace {

inline constexpr std::array<char, 8> kMagic = {'C', 'T', 'C', 'A', 'C', 'H', 'E', '1'};
inline constexpr std::uint32_t kMaxSpes = 256;
inline constexpr std::uint32_t kMaxChunkWords = 1 << 16;

/// Operation in files only: the upper bits say how many times more the word before is repeated.
inline constexpr std::uint32_t kRepeat = 23;
static_assert(kRepeat == static_cast<std::uint32_t>(Operation::end));
inline constexpr std::uint32_t kMaxRepeat = (1u << (32 - kOperationBits)) - 1;

/// The numbers before the words of a chunk.
struct ChunkHead {
  std::uint32_t spe;
  std::uint32_t cache; ///< number among the caches of the SPE, in the order of their construction
  std::uint32_t words;
};

/// Returns the operation of a word, without its kind of data.
constexpr Operation operation_of(std::uint32_t word) {
  const std::uint32_t code = word & kOperationMask;
  return static_cast<Operation>(code < 16 ? code & 8 : code);
}
constexpr bool is_reference(std::uint32_t word) {
  return (word & kOperationMask) < 2 * kKinds;
}

} // namespace celltrace::cache_trace
