// What a lookup in the software cache costs on the host, apart from DMA: hits, misses, and reads without a
// cache.
#include "celltrace/cache.hpp"
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
  using simd = HostSimd<xsimd::sse2>;

  template <class T> T* allocate(std::uint32_t count, std::uint32_t alignment = kLineBytes) {
    next_ = (next_ + alignment - 1) & ~(alignment - 1);
    T* objects = new (store_ + next_) T[count]();
    next_ += static_cast<std::uint32_t>(count * sizeof(T));
    return objects;
  }
  void get(void* ls, ea_t ea, std::uint32_t size, std::uint32_t) {
    std::memcpy(ls, reinterpret_cast<const void*>(ea), size);
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

/// Reads words all over `state.range(0)` lines, 4 x 128 of which fit into the cache.
void read_words(benchmark::State& state, const CacheConfig& config) {
  const auto lines = static_cast<std::uint32_t>(state.range(0));
  const std::vector<Line> memory(lines);
  const auto spu = std::make_unique<CopyingSpu>();
  SoftwareCache<CopyingSpu> cache(*spu, config, reinterpret_cast<std::uintptr_t>(memory.data()));
  std::uint32_t random = 1;
  for (auto _ : state) {
    random = random * 1664525u + 1013904223u;
    const std::uint32_t line = static_cast<std::uint32_t>(std::uint64_t{random} * lines >> 32);
    benchmark::DoNotOptimize(cache.word(line * kLineBytes, 0));
  }
  const CacheCounters counters = cache.counters(0);
  state.counters["hit ratio"] = counters.hits / (1.0 * counters.hits + counters.misses);
}

CacheConfig shape(std::uint32_t ways, std::uint32_t sets, CacheReplacement replacement) {
  CacheConfig config;
  config.ways = ways;
  config.sets = sets;
  config.replacement = replacement;
  return config;
}
CacheConfig disabled() {
  CacheConfig config;
  config.enabled = false;
  return config;
}

BENCHMARK_CAPTURE(read_words, 4x128_random, shape(4, 128, CacheReplacement::random))->Arg(256)->Arg(1024);
BENCHMARK_CAPTURE(read_words, 4x128_fifo, shape(4, 128, CacheReplacement::fifo))->Arg(256)->Arg(1024);
BENCHMARK_CAPTURE(read_words, 4x128_lru, shape(4, 128, CacheReplacement::lru))->Arg(256)->Arg(1024);
BENCHMARK_CAPTURE(read_words, 1x512, shape(1, 512, CacheReplacement::random))->Arg(256)->Arg(1024);
BENCHMARK_CAPTURE(read_words, full_512, shape(512, 1, CacheReplacement::random))->Arg(256)->Arg(1024);
BENCHMARK_CAPTURE(read_words, off, disabled())->Arg(256)->Arg(1024);

} // namespace
