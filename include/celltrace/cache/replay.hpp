// Replays a recorded trace through caches of any shape, and through the best possible one. On the host.
#pragma once

#include "celltrace/cache/trace.hpp"
#include "celltrace/export.hpp"

#include <array>
#include <cstdint>

namespace celltrace {

/// Hits, misses and transfers of a cache, since the last time that the program reset its counters.
struct CELLTRACE_EXPORT ReplayResult {
  struct Counters {
    std::uint64_t hits = 0, misses = 0;
  };
  std::array<Counters, cache_trace::kKinds> kinds{}; ///< reads and writes
  std::uint64_t fetched = 0;                         ///< lines fetched by references and prefetches
  std::uint64_t written_back = 0;                    ///< lines, or parts of lines, written back

  Counters total() const;
  /// Returns hits per reference, 0..1; 0 if there was none.
  double hit_rate() const;
};

/// Returns the sums of both results; for the caches of several SPEs.
CELLTRACE_EXPORT ReplayResult operator+(ReplayResult a, const ReplayResult& b);

/// Replays all requests to the recorded cache with a cache of the given shape. With the recorded shape, hits
/// and misses are the same as in the recorded run. Throws InputError for a shape that is not valid.
CELLTRACE_EXPORT ReplayResult replay(const CacheTrace& trace, const CacheConfig& shape);

/// Replays the trace with the fewest fetches that `sets` sets of `ways` ways allow: the line that is replaced
/// is the one whose next use is farthest away (Belady, "A study of replacement algorithms for a
/// virtual-storage computer", 1966). Every requested line is taken in. With sets == 1 this is the limit for
/// every cache with that number of lines; its misses are the fewest possible if the trace has no prefetches.
/// `ways` may be any number; `sets` is a power of two, or InputError is thrown. Nothing is written back.
CELLTRACE_EXPORT ReplayResult optimal(const CacheTrace& trace, std::uint32_t ways, std::uint32_t sets = 1);

} // namespace celltrace
