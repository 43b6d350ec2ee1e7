// Reads runs of words longer than a line, such as lists of objects, through a software cache. Kernel dialect.
#pragma once

#include "celltrace/cache/software_cache.hpp"

#include <stdint.h>

namespace celltrace {

/// Reads words one after the other, with one reference to the cache for each line. The run copies the line
/// that it reads, so that the program may use the cache otherwise between words. The run prefetches the next
/// line: a program that leaves a run early has to settle() the cache before the program ends.
///
///   for (WordRun list(cache, offset, count, Kind::list); !list.empty();)
///     visit(list.next());
template <class Spu, class Kind, class Options> class WordRun {
public:
  using Cache = SoftwareCache<Spu, Kind, Options>;

  /// Starts a run of `count` words from `offset`, a multiple of 4.
  WordRun(Cache& cache, uint32_t offset, uint32_t count, Kind kind)
      : cache_(cache), offset_(offset), count_(count), kind_(kind) {
    if constexpr (!Spu::direct_memory) {
      if (count != 0) fetch_line();
    }
  }

  bool empty() const { return count_ == 0; }
  /// Returns the next word; the run must not be empty.
  uint32_t next() {
    --count_;
    if constexpr (Spu::direct_memory) {
      const uint32_t word = cache_.word(offset_, kind_);
      offset_ += 4;
      return word;
    } else {
      const uint32_t word = line_.words[(offset_ & kLineMask) / 4];
      offset_ += 4;
      if ((offset_ & kLineMask) == 0 && count_ != 0) fetch_line();
      return word;
    }
  }

private:
  static constexpr uint32_t kLineMask = kLineBytes - 1;
  struct alignas(16) Line {
    uint32_t words[kLineBytes / 4];
  };
  struct NoLine {};

  void fetch_line() {
    const uint32_t line = offset_ & ~kLineMask;
    // Prefetch first: the pointer that the copy reads from would not survive a later prefetch.
    if (count_ > (kLineBytes - (offset_ - line)) / 4) cache_.prefetch(line + kLineBytes);
    using U4 = typename Spu::simd::U4;
    const auto fetched = cache_.template get<Line>(line, kind_);
    const uint32_t* const words = fetched->words;
    for (uint32_t i = 0; i < kLineBytes / 4; i += 4)
      U4::load(words + i).store(line_.words + i);
  }

  Cache& cache_;
  uint32_t offset_;
  uint32_t count_;
  Kind kind_;
  std::conditional_t<Spu::direct_memory, NoLine, Line> line_;
};

template <class Spu, class Kind, class Options>
WordRun(SoftwareCache<Spu, Kind, Options>&, uint32_t, uint32_t, Kind) -> WordRun<Spu, Kind, Options>;

} // namespace celltrace
