// Recordings of what software caches were asked for, on the host: written while SPEs run on cell_emu, kept in
// files, replayed through caches of any shape (replay.hpp).
//
//   std::ofstream file("scene.cachetrace", std::ios::binary);
//   CacheTraceWriter writer(file);
//   options.emulation.recorder = &writer;     // RenderOptions, or MachineConfig
//   ... render ...
//   writer.finish();
//
// docs/software-cache.md describes the file.
#pragma once

#include "celltrace/cache/config.hpp"
#include "celltrace/cache/trace_words.hpp"
#include "celltrace/export.hpp"
#include "celltrace/spe/recorder.hpp"

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <vector>

namespace celltrace {

/// One thing that a cache was asked for.
struct CacheRequest {
  cache_trace::Operation operation = cache_trace::Operation::read;
  std::uint8_t kind = 0;   ///< of a read or a write; below kKinds
  std::uint32_t line = 0;  ///< its number; of synchronize the first
  std::uint32_t count = 1; ///< of a read or a write: how often, without pause; of synchronize: lines
};

/// What one cache was asked for, from its construction on.
struct CacheTrace {
  unsigned spe = 0;
  /// The shape that it had; its DMA tags are not recorded.
  CacheConfig config;
  std::vector<CacheRequest> requests;
};

/// Without its prefetches: what is left is what a program has to wait for if nothing is fetched ahead.
CELLTRACE_EXPORT CacheTrace without_prefetches(CacheTrace trace);

/// Writes what the caches of a machine record. Memory that is needed does not grow with the run.
class CELLTRACE_EXPORT CacheTraceWriter : public SpeRecorder {
public:
  /// `file` is a binary stream that outlives the writer.
  explicit CacheTraceWriter(std::ostream& file);
  /// Finishes, if finish() was not called.
  ~CacheTraceWriter() override;

  /// By an SPE's thread, as SpeRecorder says.
  void record(unsigned spe, const void* source, std::uint32_t word) override;
  /// Once no SPE runs any more: writes what is left. Whether all of it arrived is the stream's state.
  void finish();

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// All traces of a file, ordered by SPE and then by age. Throws InputError if it is none, is damaged, or has
/// more than `max_requests` requests, which are what takes memory.
CELLTRACE_EXPORT std::vector<CacheTrace> read_cache_traces(std::istream& file,
                                                           std::uint64_t max_requests = 1u << 27);

} // namespace celltrace
