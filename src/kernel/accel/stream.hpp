// Sequential reads and writes of long arrays in main memory by DMA with two buffers. Where memory is direct
// there are no buffers. Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"
#include "kernel/direct/door.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// Reads `count` records of type T (a size that divides 16 KB) from `source`, which is aligned like T and at
/// least to 16 bytes; memory up to the next multiple of 16 bytes past the end is readable. Uses two tags from
/// `tag` on.
template <class Spu, class T> class StreamReader {
public:
  static constexpr uint32_t kChunk = kMaxDmaBytes / sizeof(T);

  StreamReader(Spu& spu, uint32_t tag) : spu_(spu), tag_(tag) {
    static_assert(kMaxDmaBytes % sizeof(T) == 0, "records may not straddle chunks");
    if constexpr (!kReadsInPlace<Spu>)
      for (uint32_t i = 0; i < 2; ++i)
        buffer_[i] = spu.template allocate<T>(kChunk);
  }

  /// Calls `visit(record, index)` for every record in order.
  template <class Visit> void for_each(ea_t source, uint32_t count, Visit visit) {
    if constexpr (kReadsInPlace<Spu>) {
      const T* records = reinterpret_cast<const T*>(static_cast<uintptr_t>(source));
      for (uint32_t i = 0; i < count; ++i)
        visit(records[i], i);
    } else {
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
  }

private:
  void fetch(ea_t source, uint32_t count, uint32_t first, uint32_t into) {
    const uint32_t n = count - first < kChunk ? count - first : kChunk;
    const uint32_t bytes = (n * static_cast<uint32_t>(sizeof(T)) + 15u) & ~15u;
    if (bytes != 0)
      spu_.get(buffer_[into], source + static_cast<ea_t>(first) * sizeof(T), bytes, tag_ + into);
  }

  Spu& spu_;
  uint32_t tag_;
  T* buffer_[2] = {nullptr, nullptr};
};

/// Writes records of type T (8 bytes or less, a power of two) in order to `target`, which is 128-byte
/// aligned; flush() rounds the last transfer up to 16 bytes. Uses two tags from `tag` on.
template <class Spu, class T> class StreamWriter {
public:
  static constexpr uint32_t kChunk = 4096 / sizeof(T);

  StreamWriter(Spu& spu, uint32_t tag, ea_t target) : spu_(spu), tag_(tag), target_(target) {
    if constexpr (!kReadsInPlace<Spu>)
      for (uint32_t i = 0; i < 2; ++i)
        buffer_[i] = spu.template allocate<T>(kChunk);
  }

  void write(const T& record) {
    if constexpr (kReadsInPlace<Spu>) {
      reinterpret_cast<T*>(static_cast<uintptr_t>(target_))[count_++] = record;
    } else {
      buffer_[current_][count_++ & (kChunk - 1)] = record;
      if ((count_ & (kChunk - 1)) == 0) send(kChunk);
    }
  }

  /// Sends what is left and waits for all of it.
  void flush() {
    if constexpr (!kReadsInPlace<Spu>) {
      if ((count_ & (kChunk - 1)) != 0) send(count_ & (kChunk - 1));
      spu_.wait_all(3u << tag_);
    }
  }
  uint32_t count() const { return count_; }

private:
  void send(uint32_t n) {
    const uint32_t bytes = (n * static_cast<uint32_t>(sizeof(T)) + 15u) & ~15u;
    spu_.put(buffer_[current_], target_ + sent_, bytes, tag_ + current_);
    sent_ += bytes;
    current_ ^= 1;
    // The other buffer is about to be filled: its last transfer has to be over.
    spu_.wait_all(1u << (tag_ + current_));
  }

  Spu& spu_;
  uint32_t tag_;
  ea_t target_;
  ea_t sent_ = 0;
  uint32_t count_ = 0;
  uint32_t current_ = 0;
  T* buffer_[2] = {nullptr, nullptr};
};

} // namespace celltrace::kernel
