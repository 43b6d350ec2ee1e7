// What the software cache costs on the host, apart from DMA, by shape: hits, misses, fetching ahead, writing,
// runs of words; and how fast traces are replayed.
#include "celltrace/cache.hpp"
#include "celltrace/cache/replay.hpp"
#include "celltrace/spe/simd_host.hpp"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

using namespace celltrace;

namespace {

/// An Spu whose transfers are copies that are complete at once.
class CopyingSpu {
public:
  static constexpr bool direct_memory = false;
  using simd = HostSimd<BaselineArch>;

  template <class T> T* allocate(std::uint32_t count = 1, std::uint32_t alignment = kLineBytes) {
    next_ = (next_ + alignment - 1) & ~(alignment - 1);
    T* objects = new (store_ + next_) T[count]();
    next_ += static_cast<std::uint32_t>(count * sizeof(T));
    return objects;
  }
  void get(void* ls, ea_t ea, std::uint32_t size, std::uint32_t) {
    std::memcpy(ls, reinterpret_cast<const void*>(ea), size);
  }
  void put(const void* ls, ea_t ea, std::uint32_t size, std::uint32_t) {
    std::memcpy(reinterpret_cast<void*>(ea), ls, size);
  }
  void getllar(void* ls, ea_t ea) { std::memcpy(ls, reinterpret_cast<const void*>(ea), kLineBytes); }
  bool putllc(const void* ls, ea_t ea) {
    std::memcpy(reinterpret_cast<void*>(ea), ls, kLineBytes);
    return true;
  }
  std::uint32_t wait_all(std::uint32_t mask) { return mask; }
  void compute(const ScalarWork&) {}
  void record(const void*, std::uint32_t) {}
  [[noreturn]] void halt(HaltCode) { std::abort(); }

private:
  alignas(kLineBytes) unsigned char store_[kLocalStoreBytes]{};
  std::uint32_t next_ = 0;
};

struct alignas(kLineBytes) Line {
  std::uint32_t words[kLineBytes / 4];
};

/// A cache, and main memory of `lines` lines before it.
template <class Cache> struct Bench {
  Bench(const CacheConfig& config, std::uint32_t lines)
      : memory(lines), spu(std::make_unique<CopyingSpu>()),
        cache(*spu, config, reinterpret_cast<std::uintptr_t>(memory.data())) {}

  std::vector<Line> memory;
  std::unique_ptr<CopyingSpu> spu;
  Cache cache;
};
using ReadOnly = SoftwareCache<CopyingSpu>;
using Checked = SoftwareCache<CopyingSpu, std::uint32_t, CheckedCacheOptions>;
using Written = WriteBackCache<CopyingSpu>;

/// Pseudo-random numbers below `bound`.
class Numbers {
public:
  explicit Numbers(std::uint32_t bound) : bound_(bound) {}
  std::uint32_t next() {
    state_ = state_ * 1664525u + 1013904223u;
    return static_cast<std::uint32_t>(std::uint64_t{state_} * bound_ >> 32);
  }

private:
  std::uint32_t bound_;
  std::uint32_t state_ = 1;
};

/// As many lines as the cache has: every read is a hit.
template <class Cache> void hit_of(benchmark::State& state, const CacheConfig& config) {
  const std::uint32_t lines = config.lines();
  Bench<Cache> bench(config, lines);
  for (std::uint32_t line = 0; line < lines; ++line)
    bench.cache.word(line * kLineBytes, 0);
  bench.cache.reset_counters();
  Numbers numbers(lines);
  for (auto _ : state)
    benchmark::DoNotOptimize(bench.cache.word(numbers.next() * kLineBytes, 0));
  state.counters["hits"] =
      static_cast<double>(bench.cache.counters(0).hits) / static_cast<double>(state.iterations());
}

void hit(benchmark::State& state, const CacheConfig& config) {
  hit_of<ReadOnly>(state, config);
}
void hit_checked(benchmark::State& state, const CacheConfig& config) {
  hit_of<Checked>(state, config);
}

/// One line after the other, of many more than the cache has: every read is a miss.
void miss(benchmark::State& state, const CacheConfig& config) {
  const std::uint32_t lines = 8 * CacheConfig::kMaxLines;
  Bench<ReadOnly> bench(config, lines);
  std::uint32_t line = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(bench.cache.word(line * kLineBytes, 0));
    line = (line + 1) % lines;
  }
  state.counters["hits"] =
      static_cast<double>(bench.cache.counters(0).hits) / static_cast<double>(state.iterations());
}

void prefetch_of_what_is_there(benchmark::State& state) {
  Bench<ReadOnly> bench(CacheConfig{}, 1);
  bench.cache.word(0, 0);
  for (auto _ : state)
    bench.cache.prefetch(0);
}
void batch_of_16_misses(benchmark::State& state) {
  const std::uint32_t lines = 8 * CacheConfig::kMaxLines;
  Bench<ReadOnly> bench(CacheConfig{}, lines);
  std::uint32_t offsets[16];
  std::uint32_t line = 0;
  for (auto _ : state) {
    for (std::uint32_t& offset : offsets)
      offset = line++ % lines * kLineBytes;
    bench.cache.fetch(offsets, 16);
  }
  state.SetItemsProcessed(state.iterations() * 16);
}
void write_hit(benchmark::State& state) {
  Bench<Written> bench(CacheConfig{}, 64);
  Numbers numbers(64 * kLineBytes / 4);
  for (auto _ : state)
    bench.cache.write(numbers.next() * 4, 1u, 0);
}
void write_miss(benchmark::State& state) {
  const std::uint32_t lines = 8 * CacheConfig::kMaxLines;
  Bench<Written> bench(CacheConfig{}, lines);
  std::uint32_t line = 0;
  for (auto _ : state) {
    bench.cache.write(line * kLineBytes, 1u, 0);
    line = (line + 1) % lines;
  }
}
/// 256 words, by WordRun and word by word.
void run_of_words(benchmark::State& state) {
  Bench<ReadOnly> bench(CacheConfig{}, 16);
  for (auto _ : state)
    for (WordRun run(bench.cache, 64, 256, 0u); !run.empty();)
      benchmark::DoNotOptimize(run.next());
  state.SetItemsProcessed(state.iterations() * 256);
}
void words_one_by_one(benchmark::State& state) {
  Bench<ReadOnly> bench(CacheConfig{}, 16);
  for (auto _ : state)
    for (std::uint32_t i = 0; i < 256; ++i)
      benchmark::DoNotOptimize(bench.cache.word(64 + 4 * i, 0));
  state.SetItemsProcessed(state.iterations() * 256);
}

/// 100,000 reads, near each other with jumps in between.
CacheTrace wandering() {
  CacheTrace trace;
  Numbers steps(16), places(1 << 14);
  std::uint32_t line = 0;
  for (int i = 0; i < 100'000; ++i) {
    line = steps.next() == 0 ? places.next() : line + steps.next() % 4;
    trace.requests.push_back({cache_trace::Operation::read, 0, line, 1});
  }
  return trace;
}
void replaying(benchmark::State& state, const CacheConfig& config) {
  const CacheTrace trace = wandering();
  for (auto _ : state)
    benchmark::DoNotOptimize(replay(trace, config).fetched);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(trace.requests.size()));
}
void optimal_replacement(benchmark::State& state) {
  const CacheTrace trace = wandering();
  for (auto _ : state)
    benchmark::DoNotOptimize(optimal(trace, 512).fetched);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(trace.requests.size()));
}

BENCHMARK_CAPTURE(hit, 1x512, CacheConfig::of(1, 512));
BENCHMARK_CAPTURE(hit, 2x256, CacheConfig::of(2, 256));
BENCHMARK_CAPTURE(hit, 4x128, CacheConfig::of(4, 128));
BENCHMARK_CAPTURE(hit, 4x128_lru, CacheConfig::of(4, 128, CacheReplacement::lru));
BENCHMARK_CAPTURE(hit, 8x64, CacheConfig::of(8, 64));
BENCHMARK_CAPTURE(hit, 512x1, CacheConfig::of(512, 1));
BENCHMARK_CAPTURE(hit_checked, 4x128, CacheConfig::of(4, 128));
BENCHMARK_CAPTURE(miss, 1x512, CacheConfig::of(1, 512));
BENCHMARK_CAPTURE(miss, 2x256, CacheConfig::of(2, 256));
BENCHMARK_CAPTURE(miss, 4x128, CacheConfig::of(4, 128));
BENCHMARK_CAPTURE(miss, 4x128_random, CacheConfig::of(4, 128, CacheReplacement::random));
BENCHMARK_CAPTURE(miss, 4x128_lru, CacheConfig::of(4, 128, CacheReplacement::lru));
BENCHMARK_CAPTURE(miss, 8x64, CacheConfig::of(8, 64));
BENCHMARK_CAPTURE(miss, 512x1, CacheConfig::of(512, 1));
BENCHMARK_CAPTURE(miss, 512x1_random, CacheConfig::of(512, 1, CacheReplacement::random));
BENCHMARK_CAPTURE(miss, off, CacheConfig::off());
BENCHMARK(prefetch_of_what_is_there);
BENCHMARK(batch_of_16_misses);
BENCHMARK(write_hit);
BENCHMARK(write_miss);
BENCHMARK(run_of_words);
BENCHMARK(words_one_by_one);
BENCHMARK_CAPTURE(replaying, 4x128, CacheConfig::of(4, 128));
BENCHMARK_CAPTURE(replaying, 512x1_lru, CacheConfig::of(512, 1, CacheReplacement::lru));
BENCHMARK(optimal_replacement);

} // namespace
