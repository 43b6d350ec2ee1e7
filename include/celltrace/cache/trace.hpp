// Traces: recordings of the requests to software caches, on the host. They are written to files while SPEs
// run on cell_emu, and replayed through caches of any shape (replay.hpp).
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

/// One request to a cache.
struct CacheRequest {
  cache_trace::Operation operation = cache_trace::Operation::read;
  std::uint8_t kind = 0;  ///< kind of data of a read or a write; below kKinds
  std::uint32_t line = 0; ///< number of the line; for synchronize, the first line
  /// For a read or a write: number of identical requests in a row, at least 1; for synchronize: number of
  /// lines.
  std::uint32_t count = 1;
};

/// All requests to one cache, from its construction on.
struct CacheTrace {
  unsigned spe = 0;
  /// The shape of the recorded cache; its DMA tags are not recorded.
  CacheConfig config;
  std::vector<CacheRequest> requests;
};

/// Returns the trace without its prefetches, as if the program fetched nothing ahead.
CELLTRACE_EXPORT CacheTrace without_prefetches(CacheTrace trace);

/// Writes the requests that the caches of a machine record. Its memory does not grow with the length of the
/// run.
class CELLTRACE_EXPORT CacheTraceWriter : public SpeRecorder {
public:
  /// `file` is a binary stream that outlives the writer.
  explicit CacheTraceWriter(std::ostream& file);
  /// Calls finish() if that has not been done.
  ~CacheTraceWriter() override;

  /// Records a word; called by an SPE's thread, as SpeRecorder says.
  void record(unsigned spe, const void* source, std::uint32_t word) override;
  /// Writes the rest of the file; call it when no SPE runs any more. The stream's state then says whether
  /// everything was written.
  void finish();

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns all traces of a file, ordered by SPE and then by age. Throws InputError if the file has another
/// format, is damaged, or has more than `max_requests` requests, a limit on memory.
CELLTRACE_EXPORT std::vector<CacheTrace> read_cache_traces(std::istream& file,
                                                           std::uint64_t max_requests = 1u << 27);

} // namespace celltrace
