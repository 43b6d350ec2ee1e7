// Fetching ahead: batches, and runs of words.
#include "fake_spu.hpp"
#include "memory.hpp"
#include "scripted_caches.hpp"

#include "celltrace/cache.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <memory>
#include <random>
#include <vector>

using namespace celltrace;
using namespace celltrace::test;

namespace {

using Cache = SoftwareCache<FakeSpu>;

std::vector<std::uint32_t> lines(std::uint32_t count) {
  std::vector<std::uint32_t> offsets(count);
  for (std::uint32_t i = 0; i < count; ++i)
    offsets[i] = i * kLineBytes + i % 32 * 4;
  return offsets;
}

} // namespace

TEST_CASE("a batch is fetched with one wait, and is hit afterwards") {
  Memory memory(64);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, CacheConfig{}, memory.base());
  cache.word(0, 0);
  const unsigned waits = spu->waits();
  const auto count = GENERATE(1u, 12u, 16u);
  const std::vector<std::uint32_t> offsets = lines(count);
  cache.fetch(offsets.data(), count);
  CHECK(spu->transfers() == count); // one of them by word()
  CHECK(spu->in_flight() == 0);
  CHECK(spu->waits() == waits + (count > 1 ? 1 : 0));
  for (const std::uint32_t offset : offsets)
    CHECK(cache.word(offset, 1) == memory.word(offset));
  CHECK(cache.counters(1).hits == count);
  CHECK(cache.counters(1).misses == 0);
  CHECK(spu->waits() == waits + (count > 1 ? 1 : 0));
}

TEST_CASE("a batch may hold a line twice, more lines than the queue, and more than the cache") {
  Memory memory(64);
  const auto spu = std::make_unique<FakeSpu>();
  CacheConfig config;
  config.ways = GENERATE(1u, 4u);
  config.sets = 2;
  config.enabled = GENERATE(true, false);
  Cache cache(*spu, config, memory.base());
  std::vector<std::uint32_t> offsets = lines(50);
  offsets.insert(offsets.begin() + 20, {0, 0, 128, 4});
  cache.prefetch(7 * kLineBytes);
  cache.fetch(offsets.data(), static_cast<std::uint32_t>(offsets.size()));
  CHECK(spu->in_flight() == 0);
  std::uint32_t wrong = 0;
  for (const std::uint32_t offset : lines(64))
    wrong += cache.word(offset, 0) != memory.word(offset);
  CHECK(wrong == 0);
  cache.fetch(nullptr, 0);
}

TEST_CASE("words of many lanes are a reference each, and a transfer a miss") {
  Memory memory(64);
  const auto spu = std::make_unique<FakeSpu>();
  CacheConfig config =
      CacheConfig::of(GENERATE(1u, 4u, 8u), 4, GENERATE(CacheReplacement::fifo, CacheReplacement::lru));
  config.enabled = GENERATE(true, false);
  Cache cache(*spu, config, memory.base());
  std::mt19937 random(3);
  std::uint32_t wrong = 0, wanted = 0;
  for (int k = 0; k < 500; ++k) {
    alignas(64) std::int32_t offsets[kSimdLanes], words[kSimdLanes];
    const std::uint32_t spread = 4u << (random() % 12);
    const std::uint32_t first = random();
    for (std::int32_t& offset : offsets)
      offset = static_cast<std::int32_t>((first + random() % spread) % memory.bytes() & ~3u);
    const std::uint32_t lanes = k % 3 == 0 ? 0xFFFF : random() & 0xFFFF;
    cache.words(Cache::Lanes::load(offsets), lanes, 2).store(words);
    for (std::uint32_t lane = 0; lane < kSimdLanes; ++lane) {
      if ((lanes >> lane & 1) == 0) continue;
      const auto offset = static_cast<std::uint32_t>(offsets[lane]);
      ++wanted;
      wrong += static_cast<std::uint32_t>(words[lane]) != memory.word(offset);
    }
  }
  CHECK(wrong == 0);
  CHECK(spu->in_flight() == 0);
  const CacheCounters seen = cache.counters(2);
  CHECK(seen.hits + seen.misses == wanted);
  CHECK(spu->transfers() == seen.misses);
  if (!config.enabled) CHECK(seen.misses == wanted);
}

TEST_CASE("a run of words is one reference a line, and the next line is under way") {
  Memory memory(64);
  const auto spu = std::make_unique<FakeSpu>();
  CacheConfig config;
  config.enabled = GENERATE(true, false);
  Cache cache(*spu, config, memory.base());
  WordRun run(cache, 120u, 70u, 2u);
  std::uint32_t offset = 120;
  std::uint32_t wrong = 0;
  for (; !run.empty(); offset += 4) {
    wrong += run.next() != memory.word(offset);
    // The cache is used for other things meanwhile.
    cache.word((offset * 7) % memory.bytes() & ~3u, 1);
    if (config.enabled && offset == 120) CHECK(spu->in_flight() == 1);
  }
  CHECK(wrong == 0);
  CHECK(offset == 120 + 70 * 4);
  // 120..127, 128..255, 256..383, 384..399
  CHECK(cache.counters(2).hits + cache.counters(2).misses == 4);
  if (config.enabled) CHECK(cache.counters(2).hits == 3);
}

TEST_CASE("runs of every length end where they should") {
  Memory memory(64);
  const auto spu = std::make_unique<FakeSpu>();
  SoftwareCache<FakeSpu, std::uint32_t, CheckedCacheOptions> cache(*spu, CacheConfig{}, memory.base());
  for (std::uint32_t offset = 0; offset < 256; offset += 36)
    for (std::uint32_t count = 0; count < 100; ++count) {
      std::uint32_t at = offset;
      std::uint32_t wrong = 0;
      for (WordRun run(cache, offset, count, 0u); !run.empty(); at += 4)
        wrong += run.next() != memory.word(at);
      CHECK(wrong == 0);
      CHECK(at == offset + 4 * count);
    }
}

TEST_CASE("batches, lanes and runs work on every SPU, and count as their model does") {
  const auto kind = GENERATE(from_range(kinds_for(cache_scripts_program())));
  const auto config = GENERATE(CacheConfig{}, CacheConfig::of(1, 2), CacheConfig::of(8, 4),
                               CacheConfig::of(4, 8, CacheReplacement::lru), CacheConfig::off());
  const auto flavour = GENERATE(CacheFlavour::plain, CacheFlavour::checked);
  CAPTURE(kind, config.ways, config.sets, config.enabled);
  ScriptedCaches caches(kind, 1, 80);
  CacheScript& script = caches.script();
  std::mt19937 random(5);
  const auto below = [&](std::uint32_t bound) { return static_cast<std::uint32_t>(random() % bound); };
  for (int round = 0; round < 60; ++round) {
    std::vector<std::uint32_t> batch(below(kMaxItems + 1));
    for (std::uint32_t& offset : batch)
      offset = below(script.bytes()) & ~3u;
    script.fetch(batch);
    std::array<std::uint32_t, kSimdLanes> lanes;
    const std::uint32_t spread = 4u << below(12);
    const std::uint32_t first = below(script.bytes());
    for (std::uint32_t& offset : lanes)
      offset = (first + below(spread)) % script.bytes() & ~3u;
    script.lanes(lanes, round % 3 == 0 ? 0xFFFF : below(0x10000), 2);
    const std::uint32_t count = below(100);
    script.run(first / 2 & ~3u, count, count, 3);
  }
  script.run(64, 1000, 1000, 4);
  script.add(CacheStep::settle);
  caches.play(flavour, config);
  caches.check_values();
  caches.check_counts();
}

TEST_CASE("a run stays where it is while the cache is used for other things") {
  const auto kind = GENERATE(from_range(kinds_for(cache_scripts_program())));
  CAPTURE(kind);
  ScriptedCaches caches(kind, 1, 64);
  CacheScript& script = caches.script();
  script.run(120, 70, 0, 2);
  for (std::uint32_t offset = 120; offset < 120 + 70 * 4; offset += 4) {
    script.add(CacheStep::next, offset, script.word(offset), 2);
    script.read((offset * 7) % script.bytes() & ~3u, 1);
  }
  caches.play(CacheFlavour::plain, CacheConfig::of(1, 2));
  caches.check_values();
  caches.check_counts();
}

TEST_CASE("a program that leaves a run before its end has to settle the cache") {
  const auto kind = GENERATE(from_range(kinds_for(cache_scripts_program())));
  const bool settles = GENERATE(false, true);
  CAPTURE(kind, settles);
  ScriptedCaches caches(kind, 1, 8);
  caches.script().run(0, 100, 1);
  if (settles) caches.script().add(CacheStep::settle);
  caches.play(CacheFlavour::plain, CacheConfig::of(4, 4));
  if (settles || kind.is_native())
    caches.check_values();
  else
    CHECK(caches.run().broke(Rule::in_flight_at_exit));
}
