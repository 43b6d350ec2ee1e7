// The checked mode: pointers that are used too late.
#include "fake_spu.hpp"
#include "memory.hpp"
#include "scripted_caches.hpp"

#include "celltrace/cache.hpp"

#include <catch2/catch.hpp>

#include <memory>

using namespace celltrace;
using namespace celltrace::test;

namespace {

using Cache = SoftwareCache<FakeSpu, std::uint32_t, CheckedCacheOptions>;

CacheConfig full(std::uint32_t ways, CacheReplacement replacement) {
  CacheConfig config;
  config.ways = ways;
  config.sets = 1;
  config.replacement = replacement;
  return config;
}

template <class Pointer> bool is_stale(const Pointer& pointer) {
  try {
    return *pointer == 0 && false;
  } catch (HaltCode code) {
    CHECK(code == HaltCode::stale_pointer);
    return true;
  }
}

} // namespace

TEST_CASE("a pointer is good until the next call") {
  Memory memory(8);
  const auto spu = std::make_unique<FakeSpu>();
  const bool enabled = GENERATE(true, false);
  CacheConfig config;
  config.enabled = enabled;
  Cache cache(*spu, config, memory.base());
  const auto get = [&] { return cache.get<std::uint32_t>(4, 0); };

  auto pointer = get();
  CHECK(*pointer == memory.word(4));
  cache.counters(0);
  cache.reset_counters();
  CHECK(*pointer == memory.word(4));
  cache.word(4, 0); // though the line is still there
  CHECK(is_stale(pointer));
  pointer = get();
  cache.prefetch(0);
  CHECK(is_stale(pointer));
  pointer = get();
  cache.synchronize(512, 4);
  CHECK(is_stale(pointer));
  pointer = get();
  cache.synchronize_all();
  CHECK(is_stale(pointer));
  pointer = get();
  cache.invalidate_all();
  CHECK(is_stale(pointer));
  pointer = get();
  const std::uint32_t offset = 0;
  cache.fetch(&offset, 1);
  CHECK(is_stale(pointer));
}

TEST_CASE("with lru a pointer is good for as many calls as there are ways") {
  Memory memory(64);
  const auto ways = GENERATE(2u, 4u, 8u);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, full(ways, CacheReplacement::lru), memory.base());
  const auto pointer = cache.get<std::uint32_t>(8, 0);
  for (std::uint32_t call = 1; call < ways; ++call) {
    cache.word(call * kLineBytes, 0);
    CHECK(*pointer == memory.word(8));
  }
  cache.word(ways * kLineBytes, 0);
  CHECK(is_stale(pointer));
}

TEST_CASE("a plain pointer that is kept too long finds poison") {
  Memory memory(4);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, CacheConfig{}, memory.base());
  const std::uint32_t* plain = cache.get<std::uint32_t>(8, 0);
  CHECK(*plain == memory.word(8));
  cache.prefetch(0);
  CHECK(*plain == Cache::kPoison);
  CHECK(cache.word(8, 0) == memory.word(8));
}

TEST_CASE("objects that cross a line, or are not aligned, are found out") {
  struct Pair {
    std::uint32_t a, b;
  };
  Memory memory(4);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, CacheConfig{}, memory.base());
  CHECK(cache.get<Pair>(120, 0)->b == memory.word(124));
  CHECK_THROWS_AS(cache.get<Pair>(124, 0), HaltCode);
  CHECK_THROWS_AS(cache.word(2, 0), HaltCode);
}

TEST_CASE("a checked cache takes the local store that it says, and counts as another") {
  Memory memory(40);
  const auto spu = std::make_unique<FakeSpu>(), plain_spu = std::make_unique<FakeSpu>();
  const CacheConfig config = full(16, CacheReplacement::lru);
  Cache cache(*spu, config, memory.base());
  SoftwareCache<FakeSpu> plain(*plain_spu, config, memory.base());
  CHECK(spu->local_store_used() == Cache::local_store_bytes(config));
  for (std::uint32_t i = 0; i < 1000; ++i)
    CHECK(cache.word(i * i % 40 * kLineBytes, 1) == plain.word(i * i % 40 * kLineBytes, 1));
  CHECK(cache.counters(1).hits == plain.counters(1).hits);
  CHECK(cache.counters(1).misses == plain.counters(1).misses);
}

TEST_CASE("a pointer that is used too late ends the program on a Cell, and is none where memory is direct") {
  const auto kind = GENERATE(from_range(kinds_for(cache_scripts_program())));
  const auto call = GENERATE(CacheStep::read, CacheStep::get, CacheStep::prefetch, CacheStep::fetch,
                             CacheStep::synchronize, CacheStep::synchronize_all, CacheStep::invalidate_all);
  CAPTURE(kind, call);
  ScriptedCaches caches(kind, 1, 4);
  CacheScript& script = caches.script();
  script.get(4);
  const std::uint32_t found = script.word(4);
  script.add(CacheStep::use, 0, found);
  script.add(CacheStep::reset_counters);
  script.add(CacheStep::use, 0, found);
  if (call != CacheStep::get) {
    script.add(call, 2 * kLineBytes, script.word(2 * kLineBytes));
  } else {
    script.add(CacheStep::read, 0, script.word(0));
    script.get(8);
    script.add(CacheStep::use, 0, script.word(8));
    script.add(CacheStep::settle);
    script.add(CacheStep::use, 0, script.word(8));
    script.read(8);
  }
  script.add(CacheStep::use, 0, call == CacheStep::get ? script.word(8) : found);
  script.add(CacheStep::invalidate_all);
  caches.play(CacheFlavour::checked, CacheConfig{});
  if (kind.is_native())
    caches.check_values();
  else
    CHECK_THAT(caches.run().error, Catch::Contains("stale pointer"));
}

TEST_CASE("with lru a pointer is good for as many calls as there are ways on every SPU") {
  const auto kind = GENERATE(from_range(kinds_for(cache_scripts_program())));
  const auto ways = GENERATE(2u, 8u);
  const bool too_late = GENERATE(false, true);
  CAPTURE(kind, ways, too_late);
  ScriptedCaches caches(kind, 1, 16);
  CacheScript& script = caches.script();
  script.get(8);
  for (std::uint32_t call = 1; call < ways + (too_late ? 1 : 0); ++call)
    script.read(call * kLineBytes);
  script.add(CacheStep::use, 0, script.word(8));
  caches.play(CacheFlavour::checked, full(ways, CacheReplacement::lru));
  if (too_late && !kind.is_native())
    CHECK_THAT(caches.run().error, Catch::Contains("stale pointer"));
  else
    caches.check_values();
}

TEST_CASE("a plain pointer that is kept too long finds poison on every Cell") {
  const auto kind = GENERATE(from_range(kinds_for(cache_scripts_program())));
  CAPTURE(kind);
  ScriptedCaches caches(kind, 1, 4);
  CacheScript& script = caches.script();
  script.get(8);
  script.add(CacheStep::prefetch);
  script.add(CacheStep::use_plain, 0, kind.is_native() ? script.word(8) : Cache::kPoison);
  script.read(8);
  caches.play(CacheFlavour::checked, CacheConfig{});
  caches.check_values();
  caches.check_counts();
}
