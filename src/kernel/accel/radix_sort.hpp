// Sorts pairs in main memory by a radix sort, least significant digit first. Input streams through local
// store, which otherwise holds a line of output for each bucket; full lines are put by DMA. Kernel dialect.
#pragma once

#include "kernel/accel/stream.hpp"
#include "kernel/scalar_work.hpp"

namespace celltrace::kernel {

struct alignas(8) SortPair {
  uint32_t key;
  uint32_t value;
};
static_assert(sizeof(SortPair) == 8, "sixteen pairs a line");

template <class Spu> class RadixSort {
public:
  /// Allocates its buffers in local store. Uses tags 8 to 15, and those of `reader`.
  RadixSort(Spu& spu, StreamReader<Spu, SortPair>& reader)
      : spu_(spu), reader_(reader), next_(spu.template allocate<uint32_t>(kBuckets)),
        begin_(spu.template allocate<uint32_t>(kBuckets)) {
    if constexpr (!kReadsInPlace<Spu>) {
      lines_ = spu.template allocate<Line>(kBuckets);
      staged_ = spu.template allocate<Line>(kStaged);
    }
  }

  /// Sorts `count` pairs that lie at buffers[0] by the low `bits` of their keys, stably; buffers are 128-byte
  /// aligned and of equal size. Returns which of them holds the result.
  uint32_t sort(const ea_t (&buffers)[2], uint32_t count, uint32_t bits) {
    uint32_t from = 0;
    for (uint32_t shift = 0; shift < bits; shift += kDigitBits, from ^= 1)
      pass(buffers[from], buffers[from ^ 1], count, shift);
    return from;
  }

private:
  static constexpr uint32_t kDigitBits = 8;
  static constexpr uint32_t kBuckets = 1u << kDigitBits;
  static constexpr uint32_t kStaged = 8;
  static constexpr uint32_t kFirstTag = 8;
  static constexpr uint32_t kPairsPerLine = kLineBytes / sizeof(SortPair);

  struct alignas(128) Line {
    SortPair pairs[kPairsPerLine];
  };

  void pass(ea_t source, ea_t target, uint32_t count, uint32_t shift) {
    for (uint32_t b = 0; b < kBuckets; ++b)
      next_[b] = 0;
    reader_.for_each(source, count, [&](const SortPair& pair, uint32_t) {
      spu_.compute(scalar_work::kCountPair);
      ++next_[digit(pair, shift)];
    });
    uint32_t sum = 0;
    for (uint32_t b = 0; b < kBuckets; ++b) {
      const uint32_t size = next_[b];
      begin_[b] = sum;
      next_[b] = sum;
      sum += size;
    }
    reader_.for_each(source, count,
                     [&](const SortPair& pair, uint32_t) { append(target, digit(pair, shift), pair); });
    if constexpr (!kReadsInPlace<Spu>) {
      for (uint32_t b = 0; b < kBuckets; ++b)
        if ((next_[b] & (kPairsPerLine - 1)) != 0 && next_[b] != begin_[b]) send(target, b);
      spu_.wait_all(((1u << kStaged) - 1) << kFirstTag);
    }
  }

  static uint32_t digit(const SortPair& pair, uint32_t shift) { return (pair.key >> shift) & (kBuckets - 1); }

  void append(ea_t target, uint32_t bucket, const SortPair& pair) {
    spu_.compute(scalar_work::kPlacePair);
    const uint32_t at = next_[bucket]++;
    if constexpr (kReadsInPlace<Spu>) {
      reinterpret_cast<SortPair*>(static_cast<uintptr_t>(target))[at] = pair;
    } else {
      lines_[bucket].pairs[at & (kPairsPerLine - 1)] = pair;
      if ((next_[bucket] & (kPairsPerLine - 1)) == 0) send(target, bucket);
    }
  }

  /// Puts the current line of a bucket by DMA. At its ends a bucket may share a line with its neighbours;
  /// there its own pairs are put one by one.
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
  StreamReader<Spu, SortPair>& reader_;
  uint32_t* next_;
  uint32_t* begin_;
  Line* lines_ = nullptr;
  Line* staged_ = nullptr;
  uint32_t slot_ = 0;
};

} // namespace celltrace::kernel
