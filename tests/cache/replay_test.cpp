// Traces of random use, replayed; and the optimal replacement against one that tries everything.
#include "memory.hpp"
#include "traces.hpp"

#include "celltrace/cache.hpp"
#include "celltrace/error.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <memory>
#include <random>
#include <set>

using namespace celltrace;
using namespace celltrace::test;

namespace {

/// All that can be done with a cache that can be written to, at random.
template <class Cache> void use(Cache& cache, const Memory& memory, unsigned seed) {
  std::mt19937 random(seed);
  std::uint32_t offset = 0;
  for (int i = 0; i < 5000; ++i) {
    if (random() % 3 != 0) offset = wander(offset, memory.bytes(), random);
    const std::uint32_t choice = random() % 256;
    if (choice < 20)
      cache.prefetch(offset);
    else if (choice < 24)
      cache.synchronize(offset, std::min<std::uint32_t>(random() % 600, memory.bytes() - offset));
    else if (choice == 24)
      cache.synchronize_all();
    else if (choice == 25 && random() % 8 == 0)
      cache.invalidate_all();
    else if (choice == 26)
      cache.flush();
    else if (choice == 27 && random() % 16 == 0)
      cache.reset_counters();
    else if (choice < 32)
      cache.fetch(std::array{offset, offset / 2 & ~3u, 0u}.data(), 3);
    else if (choice < 80)
      cache.write(offset, choice, choice % cache_trace::kKinds);
    else
      cache.word(offset, choice % cache_trace::kKinds);
  }
}

/// The fewest misses that any replacement makes of the lines, in a cache of `ways` lines, by trying all.
std::size_t fewest_misses(const std::vector<std::uint32_t>& lines, std::size_t at,
                          const std::set<std::uint32_t>& held, std::size_t ways) {
  while (at < lines.size() && held.count(lines[at]) != 0)
    ++at;
  if (at == lines.size()) return 0;
  std::set<std::uint32_t> next = held;
  next.insert(lines[at]);
  if (next.size() <= ways) return 1 + fewest_misses(lines, at + 1, next, ways);
  std::size_t fewest = lines.size();
  for (const std::uint32_t victim : held) {
    next.erase(victim);
    fewest = std::min(fewest, 1 + fewest_misses(lines, at + 1, next, ways));
    next.insert(victim);
  }
  return fewest;
}

} // namespace

TEST_CASE("a replay through the recorded shape hits and misses as the cache did, kind by kind") {
  const auto config = GENERATE(
      CacheConfig::of(1, 16, CacheReplacement::random), CacheConfig::of(2, 8, CacheReplacement::random),
      CacheConfig::of(4, 8, CacheReplacement::random), CacheConfig::of(4, 8, CacheReplacement::fifo),
      CacheConfig::of(4, 8, CacheReplacement::lru), CacheConfig::of(8, 4, CacheReplacement::random),
      CacheConfig::of(16, 1, CacheReplacement::fifo), CacheConfig::of(32, 1, CacheReplacement::lru),
      CacheConfig::off());
  const Memory memory(120);
  const auto spu = std::make_unique<FakeSpu>();
  WriteBackCache<FakeSpu> cache(*spu, config, memory.base());
  use(cache, memory, config.ways);
  const CacheTrace trace = trace_of(*spu);
  CHECK(trace.config.ways == config.ways);
  CHECK(trace.config.sets == config.sets);
  CHECK(trace.config.replacement == config.replacement);
  CHECK(trace.config.enabled == config.enabled);
  const ReplayResult result = replay(trace, trace.config);
  std::uint64_t references = 0;
  for (std::uint32_t kind = 0; kind < cache_trace::kKinds; ++kind) {
    CAPTURE(kind);
    CHECK(result.kinds[kind].hits == cache.counters(kind).hits);
    CHECK(result.kinds[kind].misses == cache.counters(kind).misses);
    references += cache.counters(kind).hits + cache.counters(kind).misses;
  }
  CHECK(references > 0);
  CHECK(result.written_back <= cache.written_back());
}

TEST_CASE("a replay through another shape is what a cache of that shape does with the same requests") {
  const Memory memory(120);
  const auto recorded = std::make_unique<FakeSpu>();
  WriteBackCache<FakeSpu> cache(*recorded, CacheConfig::of(4, 8, CacheReplacement::random), memory.base());
  use(cache, memory, 99);
  const CacheTrace trace = trace_of(*recorded);
  for (const CacheConfig& other :
       {CacheConfig::of(1, 4, CacheReplacement::fifo), CacheConfig::of(2, 16, CacheReplacement::lru),
        CacheConfig::of(8, 8, CacheReplacement::lru), CacheConfig::of(64, 1, CacheReplacement::random),
        CacheConfig::off()}) {
    const auto spu = std::make_unique<FakeSpu>();
    WriteBackCache<FakeSpu> again(*spu, other, memory.base());
    use(again, memory, 99);
    const ReplayResult result = replay(trace, other);
    for (std::uint32_t kind = 0; kind < cache_trace::kKinds; ++kind) {
      CHECK(result.kinds[kind].hits == again.counters(kind).hits);
      CHECK(result.kinds[kind].misses == again.counters(kind).misses);
    }
    CHECK(spu->recorded.size() == recorded->recorded.size());
  }
}

TEST_CASE("the optimal replacement is as good as trying everything") {
  std::mt19937 random(3);
  for (int round = 0; round < 150; ++round) {
    const std::uint32_t ways = 1 + random() % 4;
    std::vector<std::uint32_t> lines(13);
    for (std::uint32_t& line : lines)
      line = random() % 6;
    const ReplayResult result = optimal(reads_of_lines(lines), ways);
    CHECK(result.total().misses == fewest_misses(lines, 0, {}, ways));
    CHECK(result.total().hits + result.total().misses == lines.size());
    CHECK(result.fetched == result.total().misses);
  }
}

TEST_CASE("no cache fetches less than the optimal one of its size, nor than that of its sets") {
  const Memory memory(120);
  const auto spu = std::make_unique<FakeSpu>();
  WriteBackCache<FakeSpu> cache(*spu, CacheConfig{}, memory.base());
  use(cache, memory, 5);
  CacheTrace trace = trace_of(*spu);
  const bool prefetches = GENERATE(true, false);
  if (!prefetches) trace = without_prefetches(trace);
  for (const CacheReplacement replacement :
       {CacheReplacement::random, CacheReplacement::fifo, CacheReplacement::lru})
    for (const auto& [ways, sets] :
         {std::pair{1u, 32u}, {2u, 16u}, {4u, 8u}, {8u, 4u}, {32u, 1u}, {4u, 1u}}) {
      const ReplayResult result = replay(trace, CacheConfig::of(ways, sets, replacement));
      const ReplayResult in_sets = optimal(trace, ways, sets);
      const ReplayResult best = optimal(trace, ways * sets);
      CHECK(best.fetched <= in_sets.fetched);
      CHECK(in_sets.fetched <= result.fetched);
      if (ways == 1) CHECK(in_sets.fetched == result.fetched);
      CHECK(result.total().hits + result.total().misses == best.total().hits + best.total().misses);
      if (prefetches) continue;
      CHECK(best.total().misses <= in_sets.total().misses);
      CHECK(in_sets.total().misses <= result.total().misses);
    }
}

TEST_CASE("once main memory has changed, not even the optimal replacement hits") {
  CacheTrace trace = reads_of_lines({1, 2, 1, 2});
  using cache_trace::Operation;
  trace.requests.insert(trace.requests.begin() + 2, {Operation::synchronize, 0, 1, 1});
  CHECK(optimal(trace, 8).total().misses == 3);
  trace.requests[2] = {Operation::synchronize_all, 0, 0, 1};
  CHECK(optimal(trace, 8).total().misses == 4);
  trace.requests[2] = {Operation::invalidate_all, 0, 0, 1};
  CHECK(optimal(trace, 8).total().misses == 4);
  trace.requests[2] = {Operation::reset_counters, 0, 0, 1};
  CHECK(optimal(trace, 8).total().misses == 0);
  CHECK(optimal(trace, 8).total().hits == 2);
  trace.requests[2] = {Operation::prefetch, 0, 9, 1};
  CHECK(optimal(trace, 2).total().misses == 3);
  CHECK(optimal(trace, 2).fetched == 4);
  CHECK(optimal(without_prefetches(trace), 2).fetched == 2);
}

TEST_CASE("a replay counts what is written back") {
  using cache_trace::Operation;
  CacheTrace trace;
  trace.requests = {{Operation::write, 3, 0, 2}, {Operation::write, 3, 1, 1}, {Operation::read, 2, 2, 5}};
  const ReplayResult result = replay(trace, CacheConfig::of(1, 1, CacheReplacement::fifo));
  CHECK(result.written_back == 2);
  CHECK(result.fetched == 3);
  CHECK(result.kinds[3].hits == 1);
  CHECK(result.kinds[3].misses == 2);
  CHECK(result.kinds[2].hits == 4);
  CHECK(result.hit_rate() == Approx(5.0 / 8));
  CHECK((result + result).written_back == 4);
  CHECK((result + result).hit_rate() == result.hit_rate());
  CHECK(ReplayResult().hit_rate() == 0);
  trace.requests.insert(trace.requests.begin() + 2, {Operation::reset_counters, 0, 0, 1});
  CHECK(replay(trace, CacheConfig::of(1, 1, CacheReplacement::fifo)).written_back == 1);
}

TEST_CASE("the last line of the 32-bit offsets can be replayed and forgotten") {
  using cache_trace::Operation;
  const std::uint32_t last = (1u << 25) - 1;
  CacheTrace trace = reads_of_lines({last, last});
  trace.requests.insert(trace.requests.begin() + 1, {Operation::synchronize, 0, 0, last + 1});
  CHECK(replay(trace, CacheConfig{}).total().misses == 2);
  CHECK(optimal(trace, 4).total().misses == 2);
}

TEST_CASE("shapes that are no cache are refused by a replay") {
  const CacheTrace trace = reads_of_lines({1});
  CHECK_THROWS_AS(replay(trace, CacheConfig::of(3, 1, CacheReplacement::lru)), InputError);
  CHECK_THROWS_AS(optimal(trace, 0), InputError);
  CHECK_THROWS_AS(optimal(trace, 4, 3), InputError);
  CHECK_THROWS_AS(optimal(trace, 4, 0), InputError);
}
