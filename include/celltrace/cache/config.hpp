// Shape and behaviour of a software cache. Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"

#include <stdint.h>
#include <type_traits>

namespace celltrace {

/// Which line of a full set makes room: any, the one fetched first, the one used least recently.
enum class CacheReplacement : uint32_t { random, fifo, lru };

/// What of a cache is known only when it is made.
struct CacheConfig {
  /// A power of two: 1 is a direct mapped cache.
  uint32_t ways = 4;
  /// A power of two: 1 is a fully associative cache. ways * sets is at most kMaxLines.
  uint32_t sets = 128;
  /// `lru` costs time at every hit, the others only at misses; docs/software-cache.md compares them.
  CacheReplacement replacement = CacheReplacement::fifo;
  /// The DMA tags first_tag .. first_tag + tag_count - 1 are the cache's own; tag_count is a power of two.
  /// Lines of different tags are waited for separately, which only matters to prefetch().
  uint32_t first_tag = 16;
  uint32_t tag_count = 8;
  /// False: nothing is kept. Every read is a DMA transfer, and a miss.
  bool enabled = true;

  static constexpr uint32_t kMaxLines = kLocalStoreBytes / kLineBytes;

  static constexpr CacheConfig of(uint32_t ways, uint32_t sets,
                                  CacheReplacement replacement = CacheReplacement::fifo) {
    CacheConfig config;
    config.ways = ways;
    config.sets = sets;
    config.replacement = replacement;
    return config;
  }
  /// Nothing is kept.
  static constexpr CacheConfig off() {
    CacheConfig config;
    config.enabled = false;
    return config;
  }

  constexpr uint32_t lines() const { return ways * sets; }
  constexpr bool valid() const {
    return power_of_two(ways) && power_of_two(sets) && ways <= kMaxLines && sets <= kMaxLines &&
           lines() <= kMaxLines && power_of_two(tag_count) && tag_count <= kMfcTags &&
           first_tag <= kMfcTags - tag_count;
  }
  /// Local store that a cache without CacheOptions takes, in bytes.
  constexpr uint32_t local_store_bytes() const {
    return enabled ? lines() * (kLineBytes + kWordBytes) + tag_words() * kWordBytes
                   : kLineBytes + 4 * kWordBytes;
  }
  /// A set has at least one quadword of tags.
  constexpr uint32_t tag_words() const { return sets * (ways < 4 ? 4 : ways); }

private:
  static constexpr uint32_t kWordBytes = 4;
  static constexpr bool power_of_two(uint32_t n) { return n != 0 && (n & (n - 1)) == 0; }
};

/// What of a cache is known when it is compiled: an option that is off costs nothing.
struct CacheOptions {
  /// Pointers are watched: see lifetimes.hpp.
  static constexpr bool checked = false;
  /// The cache can be written to: see dirty_bytes.hpp.
  static constexpr bool write_back = false;
};
struct CheckedCacheOptions : CacheOptions {
  static constexpr bool checked = true;
};
struct WriteBackCacheOptions : CacheOptions {
  static constexpr bool write_back = true;
};

/// The options of caches that do not say otherwise: `Spu::cache_options` if the Spu has such a type, so that
/// a kernel can be run with other options as it is.
template <class Spu, class = void> struct DefaultCacheOptions { using type = CacheOptions; };
template <class Spu> struct DefaultCacheOptions<Spu, std::void_t<typename Spu::cache_options>> {
  using type = typename Spu::cache_options;
};

/// The set of the line at an offset, before the number of sets is masked out. Two digits of the line's number
/// are combined: tables of a scene, and rows of a grid, are often a power of two of lines apart, and would
/// come into each other's way in one set.
constexpr uint32_t cache_set(uint32_t offset) {
  return offset >> 7 ^ offset >> 13;
}

/// References to one kind of data.
struct CacheCounters {
  uint32_t hits;
  uint32_t misses;
};

/// The random numbers of CacheReplacement::random: the linear congruential generator of Numerical Recipes.
class CacheRandom {
public:
  constexpr uint32_t next_below_power_of_two(uint32_t bound) {
    state_ = state_ * 1664525u + 1013904223u;
    return state_ >> 16 & (bound - 1);
  }

private:
  uint32_t state_ = 0;
};

} // namespace celltrace
