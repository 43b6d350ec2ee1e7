// What crosses DMA when SPEs play scripts for software caches (script_player.hpp). Kernel dialect.
#pragma once

#include "celltrace/cache/trace_words.hpp"
#include "celltrace/spe/types.hpp"

#include <stdint.h>

namespace celltrace::test {

/// What is asked of the cache. What it has to find there is the entry's value, unless that says otherwise.
enum class CacheStep : uint32_t {
  read,            ///< word()
  read_byte,       ///< get() of a byte
  read_block,      ///< copy() of a CacheBlock; value: sum_of_words() of it
  read_line,       ///< get() of a CacheLine; value: likewise
  get,             ///< get() of a word, the pointer to which is kept
  use,             ///< looks where that points
  use_plain,       ///< looks where a plain pointer that was made of it points
  item,            ///< one more offset for fetch or lanes; value: for lanes
  fetch,           ///< fetch() of the items before
  lanes,           ///< words() of the 16 items before; value: the lanes that are wanted
  run,             ///< begins a WordRun; value: how many words
  next,            ///< its next word
  prefetch,        ///< value: nothing, as below
  settle,          ///<
  synchronize,     ///< value: bytes
  synchronize_all, ///<
  invalidate_all,  ///<
  reset_counters,  ///<
  change,          ///< past the cache, the word in main memory becomes `value`
  // Caches that can be written to.
  write_byte,  ///< value: written
  write_word,  ///< likewise
  write_block, ///< value: of its first word; the next one is greater by 1, and so on
  write_line,  ///< likewise
  flush,       ///<
};

struct alignas(16) CacheEntry {
  CacheStep step;
  uint32_t kind; ///< of data, below cache_trace::kKinds
  uint32_t offset;
  uint32_t value;
};
static_assert(sizeof(CacheEntry) == 16, "crosses DMA");

/// CacheOptions by number.
enum class CacheFlavour : uint32_t { plain, checked, write_back };

/// One SPE's task. The argument of the program is that of SPE 0; the others follow.
struct alignas(128) CacheTask {
  ea_t memory; ///< what is cached
  ea_t script; ///< CacheEntries, 128-byte aligned, whole lines of them
  ea_t report; ///< a CacheReport
  uint32_t entries;
  CacheFlavour flavour;
  uint32_t ways, sets, replacement, enabled;
  uint32_t first_tag, tag_count;
  uint32_t unused[18];
};
static_assert(sizeof(CacheTask) == 128, "crosses DMA");

struct alignas(128) CacheReport {
  uint32_t played;      ///< entries
  uint32_t wrong;       ///< values that were not found
  uint32_t first_wrong; ///< index of the first entry whose value was not found
  uint32_t written_back;
  uint32_t local_store_bytes; ///< that the cache took
  uint32_t hits[cache_trace::kKinds];
  uint32_t misses[cache_trace::kKinds];
  uint32_t unused[11];
};
static_assert(sizeof(CacheReport) == 128, "crosses DMA");

struct alignas(16) CacheBlock {
  uint32_t words[4];
};
struct alignas(128) CacheLine {
  uint32_t words[kLineBytes / 4];
};

constexpr uint32_t kMaxItems = 64; ///< of a batch

/// Depends on the order of the words.
constexpr uint32_t sum_of_words(const uint32_t* words, uint32_t count) {
  uint32_t sum = 0;
  for (uint32_t i = 0; i < count; ++i)
    sum = (sum << 3 | sum >> 29) + words[i];
  return sum;
}

} // namespace celltrace::test
