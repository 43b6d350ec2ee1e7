// Replays a recorded trace through caches of any shape, and through a cache with optimal replacement. On the
// host.
#pragma once

#include "celltrace/cache/trace.hpp"
#include "celltrace/export.hpp"

#include <array>
#include <cstdint>

namespace celltrace {

/// Hits, misses and transfers of a cache since the recorded program last reset the cache's counters.
struct CELLTRACE_EXPORT ReplayResult {
  struct Counters {
    std::uint64_t hits = 0, misses = 0;
  };
  std::array<Counters, cache_trace::kKinds> kinds{}; ///< reads and writes
  std::uint64_t fetched = 0;                         ///< lines fetched by references and prefetches
  std::uint64_t written_back = 0;                    ///< lines, or parts of lines, written back

  Counters total() const;
  /// Returns hits per reference, 0..1; 0 if there were no references.
  double hit_rate() const;
};

/// Returns the sums of both results; for the caches of several SPEs.
CELLTRACE_EXPORT ReplayResult operator+(ReplayResult a, const ReplayResult& b);

/// Replays all requests of the trace with a cache of the given shape. With the shape of the recorded cache,
/// hits and misses are the same as in the recorded run. Throws InputError for an invalid shape.
CELLTRACE_EXPORT ReplayResult replay(const CacheTrace& trace, const CacheConfig& shape);

/// Replays the trace with the fewest fetches that `sets` sets of `ways` ways allow: it replaces the line
/// whose next use is farthest away (Belady, "A study of replacement algorithms for a virtual-storage
/// computer", 1966). Every requested line is cached. With sets == 1 no cache of `ways` lines can have fewer
/// fetches, nor fewer misses if the trace has no prefetches. `ways` may be any number. Throws InputError if
/// `sets` is not a power of two. Nothing is written back.
CELLTRACE_EXPORT ReplayResult optimal(const CacheTrace& trace, std::uint32_t ways, std::uint32_t sets = 1);

} // namespace celltrace
