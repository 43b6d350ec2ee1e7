// Radix sort of pairs in main memory, least significant digit first. Kernel dialect.
#pragma once

#include "kernel/accel/stream.hpp"
#include "kernel/scalar_work.hpp"

namespace celltrace::kernel {

struct alignas(8) SortPair {
  uint32_t key;
  uint32_t value;
};
static_assert(sizeof(SortPair) == 8, "sixteen pairs a line");

constexpr uint32_t kSortDigitBits = 8, kSortBuckets = 1u << kSortDigitBits;

template <class Spu> class RadixSort {
public:
  /// Allocates the buffers in local store. Uses tags 8 to 15, and those of `reader`.
  RadixSort(Spu& spu, StreamReader<Spu, SortPair>& reader)
      : spu_(spu), reader_(reader), next_(spu.template allocate<uint32_t>(kSortBuckets)),
        begin_(spu.template allocate<uint32_t>(kSortBuckets)), target_(spu, begin_, next_) {}

  /// Sorts `count` pairs that lie at buffers[0] by the low `bits` of their keys, stably; buffers are 128-byte
  /// aligned and of equal size. Returns the index of the buffer with the result.
  uint32_t sort(const ea_t (&buffers)[2], uint32_t count, uint32_t bits) {
    uint32_t from = 0;
    for (uint32_t shift = 0; shift < bits; shift += kSortDigitBits, from ^= 1)
      pass(buffers[from], buffers[from ^ 1], count, shift);
    return from;
  }

private:
  void pass(ea_t source, ea_t target, uint32_t count, uint32_t shift) {
    for (uint32_t b = 0; b < kSortBuckets; ++b)
      next_[b] = 0;
    reader_.for_each(source, count, [&](const SortPair& pair, uint32_t) {
      spu_.compute(scalar_work::kCountPair);
      ++next_[digit(pair, shift)];
    });
    uint32_t sum = 0;
    for (uint32_t b = 0; b < kSortBuckets; ++b) {
      const uint32_t size = next_[b];
      begin_[b] = sum;
      next_[b] = sum;
      sum += size;
    }
    reader_.for_each(source, count, [&](const SortPair& pair, uint32_t) {
      spu_.compute(scalar_work::kPlacePair);
      target_.put(target, digit(pair, shift), pair);
    });
    target_.finish(target);
  }

  static uint32_t digit(const SortPair& pair, uint32_t shift) {
    return (pair.key >> shift) & (kSortBuckets - 1);
  }

  Spu& spu_;
  StreamReader<Spu, SortPair>& reader_;
  uint32_t* next_;  ///< index: bucket; index of the bucket's next pair
  uint32_t* begin_; ///< index: bucket; index of the bucket's first pair
  /// Stores pairs at the next places of their buckets; after finish() they are in main memory.
  typename Strategy<Spu>::template SortTarget<Spu> target_;
};

} // namespace celltrace::kernel
