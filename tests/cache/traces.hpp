// Traces without a machine: what a cache records on a FakeSpu, by way of a file.
#pragma once

#include "celltrace/cache/replay.hpp"
#include "fake_spu.hpp"

#include <catch2/catch.hpp>

#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

namespace celltrace::test {

/// The file that results if SPE `spe` records these words.
inline std::string file_of(const std::vector<std::uint32_t>& words, unsigned spe = 0) {
  std::ostringstream file;
  CacheTraceWriter writer(file);
  for (const std::uint32_t word : words)
    writer.record(spe, &words, word);
  writer.finish();
  return file.str();
}

inline std::vector<CacheTrace> traces_in(const std::string& bytes) {
  std::istringstream file(bytes);
  return read_cache_traces(file);
}

/// The trace of the one cache that `spu` had.
inline CacheTrace trace_of(const FakeSpu& spu) {
  const std::vector<CacheTrace> traces = traces_in(file_of(spu.recorded));
  REQUIRE(traces.size() == 1);
  return traces[0];
}

/// Reads of kind 0.
inline CacheTrace reads_of_lines(const std::vector<std::uint32_t>& lines) {
  CacheTrace trace;
  for (const std::uint32_t line : lines)
    trace.requests.push_back({cache_trace::Operation::read, 0, line, 1});
  return trace;
}

} // namespace celltrace::test
