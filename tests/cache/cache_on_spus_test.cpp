// The cache on every SPU type that this host can run.
#include "memory.hpp"
#include "model.hpp"
#include "spe/run_on.hpp"

#include "celltrace/cache.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace celltrace;
using namespace celltrace::test;

namespace {

struct Control {
  CacheConfig config;
  Memory* memory;
  std::vector<std::uint32_t> trace; ///< offsets to read; odd ones to prefetch
  std::uint32_t wrong = 0;
  CacheCounters counters{};
};

std::vector<std::uint32_t> random_trace(const Memory& memory, std::size_t length) {
  std::mt19937 random(7);
  std::vector<std::uint32_t> trace;
  std::uint32_t offset = 0;
  while (trace.size() < length) {
    offset = wander(offset, memory.bytes(), random);
    trace.push_back(random() % 4 == 0 ? offset | 1 : offset);
  }
  return trace;
}

constexpr auto kReadAll = [](auto& spu, ea_t argument) {
  Control& control = at<Control>(argument);
  SoftwareCache cache(spu, control.config, control.memory->base());
  for (const std::uint32_t entry : control.trace) {
    if (entry % 2 != 0)
      cache.prefetch(entry - 1);
    else
      control.wrong += cache.word(entry, 0u) != control.memory->word(entry);
  }
  cache.invalidate_all();
  control.counters = cache.counters(0);
};

CacheCounters expected_counters(const Control& control) {
  CacheModel model(control.config);
  CacheCounters counters{};
  for (const std::uint32_t entry : control.trace) {
    if (entry % 2 != 0)
      model.prefetch(entry - 1);
    else
      ++(model.read(entry) ? counters.hits : counters.misses);
  }
  return counters;
}

} // namespace

TEST_CASE("a cache works on every SPU, and counts where it is one") {
  const std::string key = GENERATE(from_range(spu_keys()));
  const auto replacement = GENERATE(CacheReplacement::random, CacheReplacement::fifo, CacheReplacement::lru);
  const auto ways = GENERATE(1u, 2u, 4u, 64u);
  INFO(key << ", " << ways << " ways");
  Control control;
  control.config.ways = ways;
  control.config.sets = ways == 64 ? 1 : 8;
  control.config.replacement = replacement;
  Memory memory(100);
  control.memory = &memory;
  control.trace = random_trace(memory, 4000);
  run_on(key, 1, kReadAll, to_ea(&control));
  CHECK(control.wrong == 0);
  const CacheCounters expected = key.starts_with("cell_emu") ? expected_counters(control) : CacheCounters{};
  CHECK(control.counters.hits == expected.hits);
  CHECK(control.counters.misses == expected.misses);
}

TEST_CASE("without a cache the data are right on every SPU") {
  const std::string key = GENERATE(from_range(spu_keys()));
  Control control;
  control.config.enabled = false;
  Memory memory(100);
  control.memory = &memory;
  control.trace = random_trace(memory, 500);
  run_on(key, 1, kReadAll, to_ea(&control));
  CHECK(control.wrong == 0);
  CHECK(control.counters.hits == 0);
}

TEST_CASE("a cache that does not fit or makes no sense ends the kernel") {
  Control control;
  Memory memory(1);
  control.memory = &memory;
  control.config.sets = 512;
  CHECK_FALSE(error_on("cell_emu", kReadAll, to_ea(&control)).empty());
  control.config.sets = 3;
  CHECK_FALSE(error_on("cell_emu", kReadAll, to_ea(&control)).empty());
}
