// Shape and behaviour of a software cache. Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"

#include <stdint.h>
#include <type_traits>

namespace celltrace {

/// The line that is replaced in a full set: a random line, the line that was fetched first, or the line that
/// was used least recently.
enum class CacheReplacement : uint32_t { random, fifo, lru };

/// Properties of a cache that are chosen at run time.
struct CacheConfig {
  /// Ways, a power of two: 1 is a direct mapped cache.
  uint32_t ways = 4;
  /// Sets, a power of two: 1 is a fully associative cache. ways * sets is at most kMaxLines.
  uint32_t sets = 128;
  /// Replacement: `lru` costs time at every hit, the others only at misses; docs/software-cache.md compares
  /// them.
  CacheReplacement replacement = CacheReplacement::fifo;
  /// DMA tags first_tag .. first_tag + tag_count - 1, which the program must not use itself; tag_count is a
  /// power of two. A cache waits for tags separately, so that waiting for one prefetched line does not wait
  /// for lines with other tags.
  uint32_t first_tag = 16;
  uint32_t tag_count = 8;
  /// False: nothing is cached. Every read is a DMA transfer, and a miss.
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
  /// Returns a configuration that caches nothing.
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
  /// Returns the bytes of local store that a cache takes with all CacheOptions off.
  constexpr uint32_t local_store_bytes() const {
    return enabled ? lines() * (kLineBytes + kWordBytes) + tag_words() * kWordBytes
                   : kLineBytes + 4 * kWordBytes;
  }
  /// Returns the number of words of tags; a set has at least one quadword.
  constexpr uint32_t tag_words() const { return sets * (ways < 4 ? 4 : ways); }

private:
  static constexpr uint32_t kWordBytes = 4;
  static constexpr bool power_of_two(uint32_t n) { return n != 0 && (n & (n - 1)) == 0; }
};

/// Properties of a cache that are chosen at compile time: an option that is false costs nothing.
struct CacheOptions {
  /// True: the lifetimes of pointers are checked (lifetimes.hpp).
  static constexpr bool checked = false;
  /// True: the cache can be written to (dirty_bytes.hpp).
  static constexpr bool write_back = false;
};
struct CheckedCacheOptions : CacheOptions {
  static constexpr bool checked = true;
};
struct WriteBackCacheOptions : CacheOptions {
  static constexpr bool write_back = true;
};

/// The default options of caches: `Spu::cache_options` if the Spu has such a type, so that an unchanged
/// kernel can run with other options.
template <class Spu, class = void> struct DefaultCacheOptions { using type = CacheOptions; };
template <class Spu> struct DefaultCacheOptions<Spu, std::void_t<typename Spu::cache_options>> {
  using type = typename Spu::cache_options;
};

/// Returns the set of the line at an offset, to be taken modulo the number of sets. Combines two groups of
/// bits of the line's number, because tables of a scene, and rows of a grid, are often a power of two of
/// lines apart, and would compete for one set.
constexpr uint32_t cache_set(uint32_t offset) {
  return offset >> 7 ^ offset >> 13;
}

/// Hits and misses of references to one kind of data.
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
