// A read-only software cache in local store over DMA: n-way set associative, lines of 128 bytes, the tags of
// a set compared by one SIMD instruction. Freestanding C++17 (kernel dialect); needs an Spu (spe/spu.hpp), no
// tracer.
//
// The design follows "An introduction to compiling for the Cell Broadband Engine, part 5: Managing memory"
// (IBM developerWorks, 2006), with the linear congruential generator of Numerical Recipes for random
// replacement.
//
// What is cached is one region of main memory, addressed by its base and 32-bit offsets. The tag of a line is
// one word: its offset with flags in the low seven bits. Only `line offset | valid` counts as a hit at first
// sight; lines under way or out of date carry further flags and are looked up again where time matters less.
#pragma once

#include "celltrace/spe/spu.hpp"
#include "celltrace/spe/types.hpp"

#include <stdint.h>

namespace celltrace {

/// Which line of a full set makes room: any, the one fetched first, the one used least recently.
enum class CacheReplacement : uint32_t { random, fifo, lru };

/// Shape and behaviour of a SoftwareCache.
struct CacheConfig {
  /// 1, 2 or 4; or with one set any power of two up to kMaxLines: a fully associative cache.
  uint32_t ways = 4;
  /// A power of two. ways * sets is at most kMaxLines.
  uint32_t sets = 128;
  CacheReplacement replacement = CacheReplacement::random;
  /// The DMA tags first_tag .. first_tag + tag_count - 1 are the cache's own; tag_count is a power of two.
  /// Lines of different tags are waited for separately, which only matters to prefetch().
  uint32_t first_tag = 16;
  uint32_t tag_count = 8;
  /// False: nothing is kept. Every read is a DMA transfer, and a miss.
  bool enabled = true;

  static constexpr uint32_t kMaxLines = kLocalStoreBytes / kLineBytes;

  constexpr uint32_t lines() const { return ways * sets; }
  constexpr bool valid() const {
    const bool any_ways = sets == 1 && power_of_two(ways) && ways <= kMaxLines;
    const bool few_ways = ways == 1 || ways == 2 || ways == 4;
    return (any_ways || few_ways) && power_of_two(sets) && sets <= kMaxLines && lines() <= kMaxLines &&
           power_of_two(tag_count) && tag_count <= kMfcTags && first_tag <= kMfcTags - tag_count;
  }
  /// Local store that the cache takes, in bytes.
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

/// Reads of one kind of data.
struct CacheCounters {
  uint32_t hits;
  uint32_t misses;
};

/// The random numbers of CacheReplacement::random.
class CacheRandom {
public:
  constexpr uint32_t next_below_power_of_two(uint32_t bound) {
    state_ = state_ * 1664525u + 1013904223u;
    return state_ >> 16 & (bound - 1);
  }

private:
  uint32_t state_ = 0;
};

/// The cache. `Kind` numbers the kinds of data whose reads are counted apart: an integer or an enumeration
/// with values below kKinds. If `Spu::direct_memory`, it is nothing but an addition, and the counters stay 0.
///
/// Lifetime of pointers: what get() returns stays valid until the next call of a member, counters apart,
/// because that call may fetch another line in its place. With replacement `lru` an enabled cache leaves it
/// alone for ways - 1 more calls of get(), copy(), word() and prefetch(). Whoever needs an object for longer
/// takes a copy().
///
/// Thread safety: one thread, as the Spu.
template <class Spu, class Kind = uint32_t> class SoftwareCache {
public:
  static constexpr uint32_t kKinds = 8;

  /// An empty cache in `spu`'s local store, taken from its arena; `spu` must outlive it. `base`: the region
  /// in main memory, 128-byte aligned and a multiple of 128 bytes long. Halts the SPE with bad_argument for
  /// an invalid configuration or base, with local_store_exhausted if the cache does not fit.
  SoftwareCache(Spu& spu, const CacheConfig& config, ea_t base) : spu_(spu), config_(config), base_(base) {
    reset_counters();
    if constexpr (!Spu::direct_memory) set_up();
  }
  SoftwareCache(const SoftwareCache&) = delete;
  SoftwareCache& operator=(const SoftwareCache&) = delete;

  /// The object at `offset`, which must not cross a line. Waits for it if need be.
  template <class T> const T* get(uint32_t offset, Kind kind) {
    static_assert(sizeof(T) <= kLineBytes, "an object must fit into a line");
    if constexpr (Spu::direct_memory)
      return reinterpret_cast<const T*>(base_ + offset);
    else
      return reinterpret_cast<const T*>(find(offset, sizeof(T), kind) + (offset & kLineMask));
  }
  /// The object by value.
  template <class T> T copy(uint32_t offset, Kind kind) { return *get<T>(offset, kind); }
  /// The word at `offset`, a multiple of 4.
  uint32_t word(uint32_t offset, Kind kind) { return *get<uint32_t>(offset, kind); }

  /// Starts to fetch the line of `offset` unless it is there. Does not wait, unless the line that makes room
  /// is itself under way. Not counted; the get() that follows is a hit if the line is still there.
  void prefetch(uint32_t offset) {
    if constexpr (!Spu::direct_memory) {
      if (config_.enabled) start_fetch_if_absent(offset & ~kLineMask);
    }
  }

  /// Forgets all lines.
  void invalidate_all() {
    if constexpr (!Spu::direct_memory) {
      if (config_.enabled) clear();
    }
  }
  /// Main memory has changed: lines are fetched again at their next reference.
  void synchronize_all() {
    if constexpr (!Spu::direct_memory) {
      for (uint32_t i = 0; i < tag_words_; ++i)
        mark_out_of_date(tags_[i]);
    }
  }
  /// As synchronize_all(), for the lines that hold [offset, offset + bytes). offset + bytes < 2^32.
  void synchronize(uint32_t offset, uint32_t bytes) {
    if constexpr (!Spu::direct_memory) {
      const uint32_t first = offset & ~kLineMask;
      const uint32_t span = offset - first + bytes;
      for (uint32_t i = 0; i < tag_words_; ++i) {
        if ((tags_[i] & ~kLineMask) - first < span && bytes != 0) mark_out_of_date(tags_[i]);
      }
    }
  }

  /// The SPU whose local store it is in.
  Spu& spu() { return spu_; }

  CacheCounters counters(Kind kind) const { return counters_[static_cast<uint32_t>(kind)]; }
  void reset_counters() {
    for (CacheCounters& each : counters_)
      each = CacheCounters{0, 0};
  }

private:
  using U4 = typename Spu::simd::U4;

  static constexpr uint32_t kLineMask = kLineBytes - 1;
  static constexpr uint32_t kLineShift = 7;
  // Flags of a tag. 0 is a free way.
  static constexpr uint32_t kValid = 1;
  static constexpr uint32_t kOutOfDate = 2; ///< the synchronize flag: to be fetched again
  static constexpr uint32_t kUnderWay = 4;  ///< its transfer has not been waited for
  /// The tag of a way that does not exist: neither free nor equal to the tag of any line, whatever its flags.
  static constexpr uint32_t kNoWay = 0xFFFFFFFFu;
  static constexpr uint32_t kNotFound = 0xFFFFFFFFu;

  // Scalar work besides the comparison of tags: fixed, floating, memory, shuffle, branches. Counted in the
  // disassembly for an SPU; see src/kernel/scalar_work.hpp for the method.
  static constexpr ScalarWork kLookup = {26, 0, 8, 9, 2};
  static constexpr ScalarWork kSlowLookup = {60, 0, 25, 25, 8};
  static constexpr ScalarWork kFetch = {85, 0, 28, 28, 6};

  // --- the way of a hit ---

  const uint8_t* find(uint32_t offset, uint32_t size, Kind kind) {
    spu_.compute(kLookup);
    const uint32_t line = offset & ~kLineMask;
    const uint32_t set = set_of(line);
    const uint32_t match = equal_bits(U4::load(tags_ + (set << 2)), U4::splat(line | kValid));
    if (__builtin_expect(match == 0, 0)) return find_slowly(offset, size, kind);
    const uint32_t slot = slot_of(set, lane_of(match));
    ++counters_[static_cast<uint32_t>(kind)].hits;
    if (stamp_hits_) stamp(slot);
    return line_at(slot);
  }

  uint32_t set_of(uint32_t line) const { return line >> kLineShift & set_mask_; }
  uint32_t slot_of(uint32_t set, uint32_t way) const { return (set << way_shift_) + way; }
  uint8_t* line_at(uint32_t slot) const { return lines_ + (slot << kLineShift); }
  /// The lane of a single bit of four.
  static uint32_t lane_of(uint32_t bit) { return (bit >> 1) - (bit >> 3); }
  static uint32_t lowest_bit(uint32_t bits) { return bits & (~bits + 1); }

  // --- misses, and lines with further flags ---

  __attribute__((noinline)) const uint8_t* find_slowly(uint32_t offset, uint32_t size, Kind kind) {
    spu_.compute(kSlowLookup);
    CacheCounters& counters = counters_[static_cast<uint32_t>(kind)];
    if (!config_.enabled) {
      ++counters.misses;
      return read_through(offset, size);
    }
    const uint32_t line = offset & ~kLineMask;
    const uint32_t set = set_of(line);
    uint32_t way = locate(set, line);
    if (up_to_date(set, way)) {
      ++counters.hits;
      if (stamp_hits_) stamp(slot_of(set, way));
    } else {
      ++counters.misses;
      way = start_fetch(set, way, line);
    }
    finish_fetch(set, way);
    return line_at(slot_of(set, way));
  }

  void start_fetch_if_absent(uint32_t line) {
    const uint32_t set = set_of(line);
    const uint32_t way = locate(set, line);
    if (!up_to_date(set, way)) start_fetch(set, way, line);
  }

  /// The way that holds the line, up to date and arrived or not; or kNotFound.
  uint32_t locate(uint32_t set, uint32_t line) const {
    const U4 state = U4::splat(~(kOutOfDate | kUnderWay));
    const U4 wanted = U4::splat(line | kValid);
    return first_way(set, state, wanted);
  }
  uint32_t free_way(uint32_t set) const { return first_way(set, U4::splat(kValid), U4::splat(0)); }
  /// The first way whose tag & mask equals `wanted`, or kNotFound.
  uint32_t first_way(uint32_t set, const U4& mask, const U4& wanted) const {
    const uint32_t* tags = tags_ + (set << 2);
    for (uint32_t way = 0; way < config_.ways; way += 4) {
      const uint32_t match = equal_bits(U4::load(tags + way) & mask, wanted);
      if (match != 0) return way + lane_of(lowest_bit(match));
    }
    return kNotFound;
  }

  /// The tag of a way. Only a set that is the only one has more than four.
  uint32_t& tag(uint32_t set, uint32_t way) { return tags_[(set << 2) + way]; }
  bool up_to_date(uint32_t set, uint32_t way) {
    return way != kNotFound && (tag(set, way) & kOutOfDate) == 0;
  }

  /// Starts to fetch a line into the way that holds it out of date, or if none does into one that makes room.
  /// Returns the way.
  uint32_t start_fetch(uint32_t set, uint32_t way, uint32_t line) {
    spu_.compute(kFetch);
    if (way == kNotFound) way = free_way(set);
    if (way == kNotFound) way = victim(set);
    finish_fetch(set, way); // two transfers into one line would race
    const uint32_t slot = slot_of(set, way);
    tag(set, way) = line | kValid | kUnderWay;
    stamp(slot);
    spu_.get(line_at(slot), base_ + line, kLineBytes, dma_tag(slot));
    return way;
  }
  void finish_fetch(uint32_t set, uint32_t way) {
    uint32_t& state = tag(set, way);
    if ((state & kUnderWay) == 0) return;
    spu_.wait_all(1u << dma_tag(slot_of(set, way)));
    state &= ~kUnderWay;
  }
  uint32_t dma_tag(uint32_t slot) const { return config_.first_tag + (slot & (config_.tag_count - 1)); }

  // --- replacement ---

  uint32_t victim(uint32_t set) {
    return config_.replacement == CacheReplacement::random ? random_.next_below_power_of_two(config_.ways)
                                                           : oldest_way(set);
  }
  uint32_t oldest_way(uint32_t set) const {
    const uint32_t* stamps = stamps_ + slot_of(set, 0);
    uint32_t oldest = 0;
    for (uint32_t way = 1; way < config_.ways; ++way) {
      if (clock_ - stamps[way] > clock_ - stamps[oldest]) oldest = way;
    }
    return oldest;
  }
  void stamp(uint32_t slot) { stamps_[slot] = ++clock_; }

  // --- without a cache ---

  /// Fetches the quadwords that the object touches. Returns the line it would lie in.
  const uint8_t* read_through(uint32_t offset, uint32_t size) {
    const uint32_t first = offset & ~15u;
    const uint32_t bytes = ((offset + size - 1) | 15u) + 1 - first;
    spu_.get(lines_ + (first & kLineMask), base_ + first, bytes, config_.first_tag);
    spu_.wait_all(1u << config_.first_tag);
    return lines_;
  }

  // --- state ---

  /// A disabled cache is one bounce line behind a set without ways, so that no lookup succeeds.
  void set_up() {
    if (!config_.valid() || (base_ & kLineMask) != 0) spu_.halt(HaltCode::bad_argument);
    const bool enabled = config_.enabled;
    tag_words_ = enabled ? config_.tag_words() : 4;
    set_mask_ = enabled ? config_.sets - 1 : 0;
    way_shift_ = enabled ? exponent_of(config_.ways) : 0;
    stamp_hits_ = enabled && config_.replacement == CacheReplacement::lru;
    lines_ = spu_.template allocate<uint8_t>((enabled ? config_.lines() : 1) * kLineBytes);
    tags_ = spu_.template allocate<uint32_t>(tag_words_, 16);
    if (enabled) stamps_ = spu_.template allocate<uint32_t>(config_.lines(), 16);
    for (uint32_t i = 0; i < tag_words_; ++i)
      tags_[i] = enabled && way_exists(i) ? 0 : kNoWay;
  }
  bool way_exists(uint32_t tag_index) const { return config_.ways >= 4 || (tag_index & 3) < config_.ways; }
  static uint32_t exponent_of(uint32_t power_of_two) {
    uint32_t exponent = 0;
    while (power_of_two >> exponent > 1)
      ++exponent;
    return exponent;
  }

  void clear() {
    spu_.wait_all(((config_.tag_count < 32 ? 1u << config_.tag_count : 0u) - 1) << config_.first_tag);
    for (uint32_t i = 0; i < tag_words_; ++i) {
      if (way_exists(i)) tags_[i] = 0;
    }
  }
  static void mark_out_of_date(uint32_t& tag) {
    if ((tag & kValid) != 0) tag |= kOutOfDate;
  }

  Spu& spu_;
  CacheConfig config_;
  ea_t base_;
  uint32_t set_mask_ = 0;
  uint32_t way_shift_ = 0;
  uint32_t tag_words_ = 0;
  bool stamp_hits_ = false;
  uint8_t* lines_ = nullptr;
  uint32_t* tags_ = nullptr;
  uint32_t* stamps_ = nullptr;
  uint32_t clock_ = 0;
  CacheRandom random_;
  CacheCounters counters_[kKinds];
};

} // namespace celltrace
