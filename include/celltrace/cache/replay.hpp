// What caches of any shape would have made of a recorded trace, and the best that any could. On the host.
#pragma once

#include "celltrace/cache/trace.hpp"
#include "celltrace/export.hpp"

#include <array>
#include <cstdint>

namespace celltrace {

/// How a cache did, since the last time that the program reset its counters.
struct CELLTRACE_EXPORT ReplayResult {
  struct Counters {
    std::uint64_t hits = 0, misses = 0;
  };
  std::array<Counters, cache_trace::kKinds> kinds{}; ///< reads and writes
  std::uint64_t fetched = 0;                         ///< lines, by references and prefetches
  std::uint64_t written_back = 0;                    ///< lines, or parts of lines

  Counters total() const;
  /// Hits per reference, 0..1; 0 if there was none.
  double hit_rate() const;
};

/// Sums; for the caches of several SPEs.
CELLTRACE_EXPORT ReplayResult operator+(ReplayResult a, const ReplayResult& b);

/// Asks a cache of the given shape for all that the recorded one was asked for. With the recorded shape, hits
/// and misses are those of the recorded run. Throws InputError for a shape that is not valid.
CELLTRACE_EXPORT ReplayResult replay(const CacheTrace& trace, const CacheConfig& shape);

/// Fetches as few lines as `sets` sets of `ways` ways can: the line that makes room is the one that is not
/// needed for the longest time (Belady, "A study of replacement algorithms for a virtual-storage computer",
/// 1966). Every line that is asked for is taken in. With sets == 1 this is the limit for every cache of so
/// many lines; its misses are the fewest possible if the trace has no prefetches. Any number of ways; `sets`
/// is a power of two; InputError if not. Nothing is written back.
CELLTRACE_EXPORT ReplayResult optimal(const CacheTrace& trace, std::uint32_t ways, std::uint32_t sets = 1);

} // namespace celltrace
