// The software cache. Its design follows "An introduction to compiling for the Cell Broadband Engine, part 5:
// Managing memory" (IBM developerWorks, 2006). Kernel dialect.
//
// A cache serves one region of main memory, addressed by its base and 32-bit offsets. The tag of a line is
// one word: its offset with flags in the low seven bits. The fast lookup finds only tags `line offset |
// valid` in the first four ways of a set. The slow lookup also finds lines under way or out of date, which
// carry further flags, and the other ways. The table of tags has the first quadwords of all sets first, then
// the second quadwords of all sets, and so on.
#pragma once

#include "celltrace/cache/config.hpp"
#include "celltrace/cache/dirty_bytes.hpp"
#include "celltrace/cache/lifetimes.hpp"
#include "celltrace/cache/trace_words.hpp"
#include "celltrace/spe/simd.hpp"
#include "celltrace/spe/spu.hpp"
#include "celltrace/spe/types.hpp"

#include <stdint.h>

namespace celltrace {

/// A cache of main memory in local store. `Kind` numbers the kinds of data whose references are counted
/// separately: an integer or an enumeration with values below kKinds. If `Spu::direct_memory`, a reference
/// only adds base and offset, and the counters stay 0.
///
/// Lifetime of pointers: the result of get() stays valid until the next call of a member other than
/// counters() and reset_counters(), because this call may replace the line. With replacement `lru` an enabled
/// cache keeps the result for ways - 1 more calls of get(), copy(), word(), write() and prefetch(). If an
/// object is needed for longer, take a copy(). CacheOptions::checked detects violations.
///
/// Thread safety: one thread, as for the Spu.
template <class Spu, class Kind = uint32_t, class Options = typename DefaultCacheOptions<Spu>::type>
class SoftwareCache : public CacheLifetimes<Spu, Options::checked && !Spu::direct_memory>,
                      public DirtyBytes<Spu, Options::write_back && !Spu::direct_memory> {
  using Lifetimes = CacheLifetimes<Spu, Options::checked && !Spu::direct_memory>;
  using Dirt = DirtyBytes<Spu, Options::write_back && !Spu::direct_memory>;

public:
  static constexpr uint32_t kKinds = cache_trace::kKinds;
  /// A word for each of kSimdLanes lanes.
  using Lanes = typename Spu::simd::I;
  /// `const T*`, or CheckedCachePointer if checked.
  template <class T> using Pointer = typename Lifetimes::template Pointer<T>;

  /// Makes an empty cache in the arena of `spu`'s local store; `spu` must outlive it. `base`: the region
  /// in main memory, 128-byte aligned and a multiple of 128 bytes long. Halts the SPE with bad_argument for
  /// an invalid configuration or base, with local_store_exhausted if the cache does not fit.
  SoftwareCache(Spu& spu, const CacheConfig& config, ea_t base) : spu_(spu), config_(config), base_(base) {
    clear_counters();
    if constexpr (!Spu::direct_memory) set_up();
  }
  SoftwareCache(const SoftwareCache&) = delete;
  SoftwareCache& operator=(const SoftwareCache&) = delete;

  /// Returns the bytes of local store that a cache with these options and this configuration takes.
  static constexpr uint32_t local_store_bytes(const CacheConfig& config) {
    return config.local_store_bytes() + Lifetimes::lifetime_bytes(config) +
           Dirt::dirt_bytes(config.enabled ? config.lines() : 1);
  }

  // --- reading ---

  /// Returns the object at `offset`, which must not cross a line. Waits for its transfer if necessary.
  template <class T> Pointer<T> get(uint32_t offset, Kind kind) {
    static_assert(sizeof(T) <= kLineBytes, "an object must fit into a line");
    return shown_at<T>(offset, sizeof(T), kind);
  }
  /// As get(), for `size` bytes of any content.
  Pointer<uint8_t> bytes(uint32_t offset, uint32_t size, Kind kind) {
    return shown_at<uint8_t>(offset, size, kind);
  }
  /// Returns a copy of the object at `offset`, which must not cross a line.
  template <class T> T copy(uint32_t offset, Kind kind) { return *get<T>(offset, kind); }
  /// Returns the word at `offset`, a multiple of 4.
  uint32_t word(uint32_t offset, Kind kind) { return *get<uint32_t>(offset, kind); }
  /// Returns the words at `offsets`, multiples of 4, for the lanes that have their bit set in `lanes`; other
  /// lanes of the result are meaningless. Each word counts as one reference, as by word(), but lanes with the
  /// same line share its lookup.
  Lanes words(const Lanes& offsets, uint32_t lanes, Kind kind) {
    if constexpr (Spu::direct_memory) {
      return words_one_by_one(offsets, lanes, kind);
    } else {
      this->end_lifetimes();
      return config_.enabled ? words_by_line(offsets, lanes, kind) : words_one_by_one(offsets, lanes, kind);
    }
  }

  // --- fetching ahead ---
  // Prefetches are not counted; the get() that follows is a hit if the line is still there.

  /// Starts to fetch the line of `offset` unless it is cached. Does not wait, unless the line to be replaced
  /// is itself under way or dirty.
  void prefetch(uint32_t offset) {
    if constexpr (!Spu::direct_memory) {
      this->begin_call();
      record(cache_trace::Operation::prefetch, offset);
      spu_.compute(kLookup);
      const uint32_t line = offset & ~kLineMask;
      if (matches(set_of(line), line) == 0) start_fetch_if_absent(line);
    } else {
      hint(offset);
    }
  }
  /// Waits for all lines that are still under way after prefetch(). A program has to call this before it
  /// ends.
  void settle() {
    if constexpr (!Spu::direct_memory) wait_for_fetches();
  }
  /// Prefetches into the host's caches if memory is direct; otherwise does nothing. For data that are mostly
  /// cached, whose lookups by prefetch() would cost more than their misses.
  void hint(uint32_t offset) {
    if constexpr (Spu::direct_memory)
      __builtin_prefetch(reinterpret_cast<const void*>(static_cast<uintptr_t>(base_ + offset)));
    else
      (void)offset;
  }
  /// Fetches the lines of `count` offsets that are not cached, with one wait for each sixteen offsets. If the
  /// cache has no room for all these lines at once, some are not cached afterwards.
  void fetch(const uint32_t* offsets, uint32_t count) {
    if constexpr (!Spu::direct_memory) {
      this->begin_call();
      for (uint32_t first = 0; first < count; first += kMfcQueueEntries)
        fetch_batch(offsets + first, count - first < kMfcQueueEntries ? count - first : kMfcQueueEntries);
    }
  }

  // --- main memory changes ---

  /// Writes back dirty lines and forgets all lines.
  void invalidate_all() {
    if constexpr (!Spu::direct_memory) {
      this->end_lifetimes();
      record(cache_trace::Operation::invalidate_all);
      clean_all();
      if (config_.enabled) clear();
    }
  }
  /// Marks all lines as out of date, because main memory has changed: each line is fetched again at its next
  /// reference. Dirty bytes are written back before the line is fetched.
  void synchronize_all() {
    if constexpr (!Spu::direct_memory) {
      this->end_lifetimes();
      record(cache_trace::Operation::synchronize_all);
      for (uint32_t i = 0; i < tag_words_; ++i)
        mark_out_of_date(tags_[i]);
    }
  }
  /// As synchronize_all(), for the lines that hold [offset, offset + bytes). offset + bytes < 2^32.
  void synchronize(uint32_t offset, uint32_t bytes) {
    if constexpr (!Spu::direct_memory) {
      this->end_lifetimes();
      if (bytes == 0) return;
      const uint32_t first = offset & ~kLineMask;
      const uint32_t span = offset - first + bytes;
      record(cache_trace::Operation::synchronize, first);
      spu_.record(this, ((span - 1) >> kLineShift) + 1);
      for (uint32_t i = 0; i < tag_words_; ++i) {
        if ((tags_[i] & ~kLineMask) - first < span) mark_out_of_date(tags_[i]);
      }
    }
  }

  /// As synchronize(), for the line at offset `line` alone; costs no more than a lookup.
  void synchronize_line(uint32_t line) {
    if constexpr (!Spu::direct_memory) {
      this->end_lifetimes();
      record(cache_trace::Operation::synchronize, line);
      spu_.record(this, 1);
      if (!config_.enabled) return;
      spu_.compute(kLookup);
      const uint32_t set = set_of(line);
      if (const uint32_t way = locate(set, line); way != kNotFound) mark_out_of_date(tag(set, way));
    }
  }

  // --- writing, with CacheOptions::write_back ---

  /// Writes an object that must not cross a line. Counts as a reference. The object is written to main memory
  /// when the line is replaced, by invalidate_all() or by flush(); if memory is direct, at once.
  template <class T> void write(uint32_t offset, const T& value, Kind kind) {
    static_assert(Options::write_back && sizeof(T) <= kLineBytes && std::is_trivially_copyable_v<T>);
    if constexpr (Spu::direct_memory) {
      *reinterpret_cast<T*>(base_ + offset) = value;
    } else {
      this->begin_call();
      record(cache_trace::Operation::write, offset, kind);
      uint8_t* line = find(offset, sizeof(T), kind);
      *reinterpret_cast<T*>(line + (offset & kLineMask)) = value;
      const uint32_t slot = static_cast<uint32_t>(line - lines_) >> kLineShift;
      this->mark_dirty(slot, offset & ~kLineMask, offset & kLineMask, sizeof(T));
    }
  }
  /// Writes all dirty bytes to main memory; the lines stay. A program has to call this before it ends.
  void flush() {
    static_assert(Options::write_back);
    if constexpr (!Spu::direct_memory) {
      record(cache_trace::Operation::flush);
      clean_all();
    }
  }

  // --- counters ---

  CacheCounters counters(Kind kind) const { return counters_[static_cast<uint32_t>(kind)]; }
  void reset_counters() {
    if constexpr (!Spu::direct_memory) record(cache_trace::Operation::reset_counters);
    clear_counters();
  }

  /// Returns the SPU whose local store holds the cache.
  Spu& spu() { return spu_; }

private:
  using U4 = typename Spu::simd::U4;

  static constexpr uint32_t kLineMask = kLineBytes - 1;
  static constexpr uint32_t kLineShift = 7;
  // Flags of a tag. 0 is a free way.
  static constexpr uint32_t kValid = 1;
  static constexpr uint32_t kOutOfDate = 2; ///< set by synchronize(): the line has to be fetched again
  static constexpr uint32_t kInFlight = 4;  ///< the line's transfer has not been waited for
  /// The tag of a way that does not exist: neither free nor equal to the tag of any line, whatever its flags.
  static constexpr uint32_t kNoWay = 0xFFFFFFFFu;
  static constexpr uint32_t kNotFound = 0xFFFFFFFFu;

  // Scalar work besides the comparison of tags, in the order of ScalarWork: fixed, floating, memory, shuffle,
  // branches, shift, waits, misses. Generated by tools/calibrate-charges.sh; see src/kernel/scalar_work.hpp.
  static constexpr ScalarWork kLookup = {21, 0, 14, 4, 5, 6, 0, 35, "kLookup"};
  static constexpr ScalarWork kReadThrough = {24, 0, 4, 6, 3, 0, 29, 52, "kReadThrough"};
  static constexpr ScalarWork kWords = {3, 0, 3, 4, 5, 8, 0, 17, "kWords"};
  static constexpr ScalarWork kLineOfLanes = {22, 0, 16, 5, 2, 6, 14, 23, "kLineOfLanes"};
  static constexpr ScalarWork kWordOfLane = {0, 0, 0, 7, 0, 0, 24, 0, "kWordOfLane"};
  static constexpr ScalarWork kStamp = {5, 0, 8, 8, 2, 3, 22, 11, "kStamp"};
  static constexpr ScalarWork kSlowLookup = {47, 0, 23, 23, 8, 10, 77, 108, "kSlowLookup"};
  static constexpr ScalarWork kFetch = {63, 0, 25, 25, 6, 10, 84, 76, "kFetch"};

  // --- hits ---

  template <class T> Pointer<T> shown_at(uint32_t offset, uint32_t size, Kind kind) {
    if constexpr (Spu::direct_memory) {
      return reinterpret_cast<const T*>(base_ + offset);
    } else {
      this->begin_call();
      record(cache_trace::Operation::read, offset, kind);
      return this->template shown<T>(find(offset, size, kind), offset & kLineMask);
    }
  }
  uint8_t* find(uint32_t offset, uint32_t size, Kind kind) {
    spu_.compute(kLookup);
    return look_up(offset, size, kind);
  }
  /// As find(), for callers that call compute() themselves.
  uint8_t* look_up(uint32_t offset, uint32_t size, Kind kind) {
    const uint32_t line = offset & ~kLineMask;
    const uint32_t set = set_of(line);
    const uint32_t match = matches(set, line);
    if (__builtin_expect(match == 0, 0)) return find_slowly(offset, size, kind);
    const uint32_t slot = slot_of(set, lane_of(match));
    ++counters_[static_cast<uint32_t>(kind)].hits;
    if (stamp_hits_ != 0) stamp_hit(slot);
    return line_at(slot);
  }

  /// Returns a bit for the way that holds the line ready to be read, among the first four ways of the set; 0
  /// if none does.
  uint32_t matches(uint32_t set, uint32_t line) const {
    return equal_bits(U4::load(tags_ + (set << 2)), U4::splat(line | kValid));
  }
  uint32_t set_of(uint32_t line) const { return cache_set(line) & set_mask_; }
  uint32_t slot_of(uint32_t set, uint32_t way) const { return (set << way_shift_) + way; }
  uint8_t* line_at(uint32_t slot) const { return lines_ + (slot << kLineShift); }
  /// Returns the number of the lane, 0..3, of a single bit.
  static uint32_t lane_of(uint32_t bit) { return (bit >> 1) - (bit >> 3); }
  static uint32_t lowest_bit(uint32_t bits) { return bits & (~bits + 1); }

  // --- many words at a time ---

  struct alignas(64) EachLane {
    uint32_t word[kSimdLanes];

    explicit EachLane(const Lanes& lanes) { lanes.store(reinterpret_cast<int32_t*>(word)); }
    Lanes load() const { return Lanes::load(reinterpret_cast<const int32_t*>(word)); }
  };
  static uint32_t lane_number(uint32_t bit) { return static_cast<uint32_t>(__builtin_ctz(bit)); }

  Lanes words_by_line(const Lanes& offsets, uint32_t lanes, Kind kind) {
    using Simd = typename Spu::simd;
    spu_.compute(kWords);
    const Lanes lines = offsets & Lanes::splat(static_cast<int32_t>(~kLineMask));
    const EachLane each(offsets);
    Lanes words = Lanes::splat(0);
    while (lanes != 0) {
      spu_.compute(kLineOfLanes);
      const uint32_t offset = each.word[lane_number(lanes)];
      record(cache_trace::Operation::read, offset, kind);
      const uint8_t* const line = look_up(offset, sizeof(uint32_t), kind);
      const auto here = lines == Lanes::splat(static_cast<int32_t>(offset & ~kLineMask));
      const uint32_t found = lanes & here.bits();
      lanes &= ~found;
      const auto others = static_cast<uint32_t>(__builtin_popcount(found)) - 1;
      counters_[static_cast<uint32_t>(kind)].hits += others;
      for (uint32_t i = 0; i < others; ++i)
        record(cache_trace::Operation::read, offset, kind);
      words = Simd::select(here, Lanes::load_words(line, offsets), words);
    }
    return words;
  }
  Lanes words_one_by_one(const Lanes& offsets, uint32_t lanes, Kind kind) {
    EachLane each(offsets);
    while (lanes != 0) {
      spu_.compute(kWordOfLane);
      uint32_t& word = each.word[lane_number(lanes)];
      lanes &= lanes - 1;
      word = this->word(word, kind);
    }
    return each.load();
  }

  // --- misses, and lines with further flags ---

  __attribute__((noinline)) uint8_t* find_slowly(uint32_t offset, uint32_t size, Kind kind) {
    CacheCounters& counters = counters_[static_cast<uint32_t>(kind)];
    if (!config_.enabled) {
      spu_.compute(kReadThrough);
      ++counters.misses;
      return read_through(offset, size);
    }
    spu_.compute(kSlowLookup);
    const uint32_t line = offset & ~kLineMask;
    const uint32_t set = set_of(line);
    uint32_t way = locate(set, line);
    if (up_to_date(set, way)) {
      ++counters.hits;
      if (stamp_hits_ != 0) stamp_hit(slot_of(set, way));
    } else {
      ++counters.misses;
      way = start_fetch(set, way, line);
    }
    finish_fetch(set, way);
    return line_at(slot_of(set, way));
  }

  __attribute__((noinline)) void start_fetch_if_absent(uint32_t line) {
    if (!config_.enabled) return;
    const uint32_t set = set_of(line);
    const uint32_t way = locate(set, line);
    if (!up_to_date(set, way)) start_fetch(set, way, line);
  }

  __attribute__((noinline)) void fetch_batch(const uint32_t* offsets, uint32_t count) {
    uint32_t dma_tags = 0;
    uint32_t* arriving[kMfcQueueEntries];
    uint32_t arriving_count = 0;
    for (uint32_t i = 0; i < count; ++i) {
      record(cache_trace::Operation::prefetch, offsets[i]);
      if (!config_.enabled) continue;
      spu_.compute(kSlowLookup);
      const uint32_t line = offsets[i] & ~kLineMask;
      const uint32_t set = set_of(line);
      uint32_t way = locate(set, line);
      if (!up_to_date(set, way)) way = start_fetch(set, way, line);
      uint32_t& state = tag(set, way);
      if ((state & kInFlight) == 0) continue;
      arriving[arriving_count++] = &state;
      dma_tags |= 1u << dma_tag(slot_of(set, way));
    }
    if (arriving_count != 0) spu_.wait_all(dma_tags);
    for (uint32_t i = 0; i < arriving_count; ++i)
      *arriving[i] &= ~kInFlight;
  }

  /// Returns the way that holds the line, also if the line is out of date or has not arrived; or kNotFound.
  uint32_t locate(uint32_t set, uint32_t line) const {
    const U4 state = U4::splat(~(kOutOfDate | kInFlight));
    const U4 wanted = U4::splat(line | kValid);
    return first_way(set, state, wanted);
  }
  uint32_t free_way(uint32_t set) const { return first_way(set, U4::splat(kValid), U4::splat(0)); }
  /// Returns the first way whose tag & mask equals `wanted`, or kNotFound.
  uint32_t first_way(uint32_t set, const U4& mask, const U4& wanted) const {
    const uint32_t* tags = tags_ + (set << 2);
    for (uint32_t way = 0; way < config_.ways; way += 4, tags += config_.sets << 2) {
      const uint32_t match = equal_bits(U4::load(tags) & mask, wanted);
      if (match != 0) return way + lane_of(lowest_bit(match));
    }
    return kNotFound;
  }

  uint32_t& tag(uint32_t set, uint32_t way) {
    return tags_[((way & ~3u) << set_shift_) + (set << 2) + (way & 3)];
  }
  bool up_to_date(uint32_t set, uint32_t way) {
    return way != kNotFound && (tag(set, way) & kOutOfDate) == 0;
  }

  /// Starts to fetch a line: into `way` if the line is there but out of date, else into a free way, else in
  /// place of another line. Returns the way.
  uint32_t start_fetch(uint32_t set, uint32_t way, uint32_t line) {
    spu_.compute(kFetch);
    if (way == kNotFound) way = free_way(set);
    if (way == kNotFound) way = victim(set);
    finish_fetch(set, way); // two transfers into one line would race
    const uint32_t slot = slot_of(set, way);
    this->clean(spu_, slot, line_at(slot), base_, dma_tag(slot));
    tag(set, way) = line | kValid | kInFlight;
    stamp(slot);
    spu_.get(line_at(slot), base_ + line, kLineBytes, dma_tag(slot));
    return way;
  }
  void finish_fetch(uint32_t set, uint32_t way) {
    uint32_t& state = tag(set, way);
    if ((state & kInFlight) == 0) return;
    spu_.wait_all(1u << dma_tag(slot_of(set, way)));
    state &= ~kInFlight;
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
  void stamp_hit(uint32_t slot) {
    spu_.compute(kStamp);
    stamp(slot);
  }

  // --- without a cache ---

  /// Fetches only the quadwords that the object touches, into the bounce line. Returns the bounce line.
  uint8_t* read_through(uint32_t offset, uint32_t size) {
    const uint32_t first = offset & ~15u;
    const uint32_t bytes = ((offset + size - 1) | 15u) + 1 - first;
    this->clean(spu_, 0, lines_, base_, config_.first_tag);
    spu_.get(lines_ + (first & kLineMask), base_ + first, bytes, config_.first_tag);
    spu_.wait_all(1u << config_.first_tag);
    return lines_;
  }

  // --- state ---

  /// Allocates the tables. A disabled cache has one bounce line, and a set without ways, so that no lookup
  /// succeeds.
  void set_up() {
    if (!config_.valid() || (base_ & kLineMask) != 0) spu_.halt(HaltCode::bad_argument);
    const bool enabled = config_.enabled;
    tag_words_ = enabled ? config_.tag_words() : 4;
    set_mask_ = enabled ? config_.sets - 1 : 0;
    set_shift_ = exponent_of(config_.sets);
    way_shift_ = enabled ? exponent_of(config_.ways) : 0;
    stamp_hits_ = enabled && config_.replacement == CacheReplacement::lru ? 1 : 0;
    lines_ = spu_.template allocate<uint8_t>(slots() * kLineBytes);
    this->set_up_lifetimes(spu_, config_);
    this->set_up_dirt(spu_, slots());
    tags_ = spu_.template allocate<uint32_t>(tag_words_, 16);
    if (enabled) stamps_ = spu_.template allocate<uint32_t>(config_.lines(), 16);
    for (uint32_t i = 0; i < tag_words_; ++i)
      tags_[i] = enabled && way_exists(i) ? 0 : kNoWay;
    record(cache_trace::Operation::begin);
    spu_.record(this, cache_trace::first_word(config_));
    spu_.record(this, cache_trace::second_word(config_));
  }
  uint32_t slots() const { return config_.enabled ? config_.lines() : 1; }
  bool way_exists(uint32_t tag_index) const { return config_.ways >= 4 || (tag_index & 3) < config_.ways; }
  static uint32_t exponent_of(uint32_t power_of_two) {
    uint32_t exponent = 0;
    while (power_of_two >> exponent > 1)
      ++exponent;
    return exponent;
  }

  void wait_for_fetches() {
    spu_.wait_all(((config_.tag_count < 32 ? 1u << config_.tag_count : 0u) - 1) << config_.first_tag);
  }
  void clear() {
    wait_for_fetches();
    for (uint32_t i = 0; i < tag_words_; ++i) {
      if (way_exists(i)) tags_[i] = 0;
    }
  }
  void clean_all() {
    if constexpr (Options::write_back) {
      for (uint32_t slot = 0; slot < slots(); ++slot)
        this->clean(spu_, slot, line_at(slot), base_, dma_tag(slot));
    }
  }
  static void mark_out_of_date(uint32_t& tag) {
    if ((tag & kValid) != 0) tag |= kOutOfDate;
  }
  void clear_counters() {
    for (CacheCounters& each : counters_)
      each = CacheCounters{0, 0};
  }

  // --- recording ---

  void record(cache_trace::Operation operation, uint32_t offset, Kind kind) {
    spu_.record(this, cache_trace::make(operation, offset & ~kLineMask, static_cast<uint32_t>(kind)));
  }
  void record(cache_trace::Operation operation, uint32_t offset = 0) {
    spu_.record(this, cache_trace::make(operation, offset & ~kLineMask));
  }

  // Each word that a hit needs is the first of a quadword: an SPU can use such a word as loaded, but has to
  // rotate any other word into the first slot.
  alignas(16) uint32_t set_mask_ = 0;
  alignas(16) uint32_t* tags_ = nullptr;
  alignas(16) uint8_t* lines_ = nullptr;
  alignas(16) uint32_t way_shift_ = 0;
  alignas(16) uint32_t stamp_hits_ = 0; ///< 0 or 1
  alignas(16) CacheCounters counters_[kKinds];
  Spu& spu_;
  CacheConfig config_;
  ea_t base_;
  uint32_t set_shift_ = 0;
  uint32_t tag_words_ = 0;
  uint32_t* stamps_ = nullptr;
  uint32_t clock_ = 0;
  CacheRandom random_;
};

/// A software cache that can be written to.
template <class Spu, class Kind = uint32_t>
using WriteBackCache = SoftwareCache<Spu, Kind, WriteBackCacheOptions>;

} // namespace celltrace
