// Streams of long arrays in main memory by DMA: two buffers for sequential reads or writes, and for sorting
// one output line for each bucket. Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"
#include "kernel/accel/radix_sort.hpp"

namespace celltrace::kernel {

template <class Spu, class T> class LocalStreamReader {
public:
  LocalStreamReader(Spu& spu, uint32_t tag) : spu_(spu), tag_(tag) {
    static_assert(kMaxDmaBytes % sizeof(T) == 0, "records may not straddle chunks");
    for (uint32_t i = 0; i < 2; ++i)
      buffer_[i] = spu.template allocate<T>(kChunk);
  }

  template <class Visit> void for_each(ea_t source, uint32_t count, Visit visit) {
    fetch(source, count, 0, 0);
    uint32_t current = 0;
    for (uint32_t first = 0; first < count; first += kChunk, current ^= 1) {
      if (first + kChunk < count) fetch(source, count, first + kChunk, current ^ 1);
      spu_.wait_all(1u << (tag_ + current));
      const uint32_t n = count - first < kChunk ? count - first : kChunk;
      for (uint32_t i = 0; i < n; ++i)
        visit(buffer_[current][i], first + i);
    }
  }

private:
  static constexpr uint32_t kChunk = kMaxDmaBytes / sizeof(T);

  void fetch(ea_t source, uint32_t count, uint32_t first, uint32_t into) {
    const uint32_t n = count - first < kChunk ? count - first : kChunk;
    const uint32_t bytes = (n * static_cast<uint32_t>(sizeof(T)) + 15u) & ~15u;
    if (bytes != 0)
      spu_.get(buffer_[into], source + static_cast<ea_t>(first) * sizeof(T), bytes, tag_ + into);
  }

  Spu& spu_;
  uint32_t tag_;
  T* buffer_[2];
};

template <class Spu, class T> class LocalStreamWriter {
public:
  LocalStreamWriter(Spu& spu, uint32_t tag, ea_t target) : spu_(spu), tag_(tag), target_(target) {
    for (uint32_t i = 0; i < 2; ++i)
      buffer_[i] = spu.template allocate<T>(kChunk);
  }

  void write(const T& record) {
    buffer_[current_][count_++ & (kChunk - 1)] = record;
    if ((count_ & (kChunk - 1)) == 0) send(kChunk);
  }
  void flush() {
    if ((count_ & (kChunk - 1)) != 0) send(count_ & (kChunk - 1));
    spu_.wait_all(3u << tag_);
  }
  uint32_t count() const { return count_; }

private:
  static constexpr uint32_t kChunk = 4096 / sizeof(T);

  void send(uint32_t n) {
    const uint32_t bytes = (n * static_cast<uint32_t>(sizeof(T)) + 15u) & ~15u;
    spu_.put(buffer_[current_], target_ + sent_, bytes, tag_ + current_);
    sent_ += bytes;
    current_ ^= 1;
    // The other buffer is filled next, so that its last transfer has to be complete.
    spu_.wait_all(1u << (tag_ + current_));
  }

  Spu& spu_;
  uint32_t tag_;
  ea_t target_;
  ea_t sent_ = 0;
  uint32_t count_ = 0;
  uint32_t current_ = 0;
  T* buffer_[2];
};

/// Output of a sort, which puts full lines by DMA.
template <class Spu> class LocalSortTarget {
public:
  LocalSortTarget(Spu& spu, const uint32_t* begin, uint32_t* next)
      : spu_(spu), begin_(begin), next_(next), lines_(spu.template allocate<Line>(kSortBuckets)),
        staged_(spu.template allocate<Line>(kStaged)) {}

  void put(ea_t target, uint32_t bucket, const SortPair& pair) {
    const uint32_t at = next_[bucket]++;
    lines_[bucket].pairs[at & (kPairsPerLine - 1)] = pair;
    if ((next_[bucket] & (kPairsPerLine - 1)) == 0) send(target, bucket);
  }
  void finish(ea_t target) {
    for (uint32_t b = 0; b < kSortBuckets; ++b)
      if ((next_[b] & (kPairsPerLine - 1)) != 0 && next_[b] != begin_[b]) send(target, b);
    spu_.wait_all(((1u << kStaged) - 1) << kFirstTag);
  }

private:
  static constexpr uint32_t kStaged = 8;
  static constexpr uint32_t kFirstTag = 8;
  static constexpr uint32_t kPairsPerLine = kLineBytes / sizeof(SortPair);

  struct alignas(128) Line {
    SortPair pairs[kPairsPerLine];
  };

  /// Puts the current line of a bucket by DMA. If neighbouring buckets share the line, puts the bucket's
  /// pairs one by one.
  void send(ea_t target, uint32_t bucket) {
    const uint32_t end = next_[bucket];
    const uint32_t line = (end - 1) & ~(kPairsPerLine - 1);
    const uint32_t first = begin_[bucket] > line ? begin_[bucket] : line;
    const uint32_t tag = kFirstTag + slot_;
    spu_.wait_all(1u << tag);
    staged_[slot_] = lines_[bucket];
    if (first == line && end == line + kPairsPerLine) {
      spu_.put(&staged_[slot_], target + static_cast<ea_t>(line) * sizeof(SortPair), kLineBytes, tag);
    } else {
      for (uint32_t i = first; i < end; ++i)
        spu_.put(&staged_[slot_].pairs[i - line], target + static_cast<ea_t>(i) * sizeof(SortPair),
                 sizeof(SortPair), tag);
    }
    slot_ = (slot_ + 1) % kStaged;
  }

  Spu& spu_;
  const uint32_t* begin_;
  uint32_t* next_;
  Line* lines_;
  Line* staged_;
  uint32_t slot_ = 0;
};

} // namespace celltrace::kernel
