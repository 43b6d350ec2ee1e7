// The cache on every SPU type that this host can run, and as machine code.
#include "scripted_caches.hpp"

#include "celltrace/cache.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>

using namespace celltrace;
using namespace celltrace::test;

namespace {

/// Reads, and prefetches of what may be read.
void wander_about(CacheScript& script, unsigned length, unsigned seed) {
  std::mt19937 random(seed);
  std::uint32_t offset = 0;
  for (unsigned i = 0; i < length; ++i) {
    offset = wander(offset, script.bytes(), random);
    if (random() % 4 == 0)
      script.add(CacheStep::prefetch, offset);
    else
      script.read(offset, random() % cache_trace::kKinds);
  }
  script.add(CacheStep::invalidate_all);
}

/// The same while main memory changes.
void wander_through_changes(CacheScript& script, unsigned length, unsigned seed) {
  std::mt19937 random(seed);
  std::uint32_t offset = 0;
  for (unsigned i = 0; i < length; ++i) {
    offset = wander(offset, script.bytes(), random);
    const auto choice = random() % 256;
    if (choice < 40) {
      script.add(CacheStep::prefetch, offset);
    } else if (choice < 44) {
      const std::uint32_t bytes = std::min<std::uint32_t>(random() % 600, script.bytes() - offset);
      script.change(offset, bytes);
      script.add(CacheStep::synchronize, offset, bytes);
    } else if (choice == 44) {
      script.add(CacheStep::synchronize_all);
    } else if (choice == 45 && random() % 16 == 0) {
      script.add(CacheStep::invalidate_all);
    } else if (choice == 46 && random() % 4 == 0) {
      script.add(CacheStep::reset_counters);
    } else {
      script.read(offset, choice % cache_trace::kKinds);
    }
  }
  script.add(CacheStep::invalidate_all);
}

std::vector<MachineKind> kinds() {
  return kinds_for(cache_scripts_program());
}
/// Where there are caches.
std::vector<MachineKind> cell_kinds() {
  std::vector<MachineKind> cells = kinds();
  std::erase_if(cells, [](const MachineKind& kind) { return kind.is_native(); });
  return cells;
}

} // namespace

TEST_CASE("a cache works on every SPU, and counts where it is one") {
  const auto kind = GENERATE(from_range(kinds()));
  const auto replacement = GENERATE(CacheReplacement::random, CacheReplacement::fifo, CacheReplacement::lru);
  const auto ways = GENERATE(1u, 2u, 4u, 64u);
  CAPTURE(kind, replacement, ways);
  ScriptedCaches caches(kind, 1, 100);
  wander_about(caches.script(), 4000, 7);
  caches.play(CacheFlavour::plain, CacheConfig::of(ways, ways == 64 ? 1 : 8, replacement));
  caches.check_values();
  caches.check_counts();
}

TEST_CASE("caches keep up with main memory on every SPU") {
  const auto kind = GENERATE(from_range(kinds()));
  CacheConfig config = GENERATE(CacheConfig::of(1, 16), CacheConfig::of(2, 8, CacheReplacement::lru),
                                CacheConfig::of(8, 4, CacheReplacement::random),
                                CacheConfig::of(16, 4, CacheReplacement::lru), CacheConfig::of(4, 128));
  config.tag_count = GENERATE(1u, 8u);
  CAPTURE(kind, config.ways, config.sets, config.tag_count);
  ScriptedCaches caches(kind, 1, 3 * config.lines() + 5);
  wander_through_changes(caches.script(), 2000, config.ways);
  caches.play(CacheFlavour::plain, config);
  caches.check_values();
  caches.check_counts();
  caches.check_memory();
}

TEST_CASE("every SPE has a cache of its own") {
  const auto kind = GENERATE(from_range(kinds()));
  const auto spes = GENERATE(2u, 8u);
  CAPTURE(kind, spes);
  ScriptedCaches caches(kind, spes, 200);
  for (unsigned spe = 0; spe < spes; ++spe)
    wander_about(caches.script(spe), 500 + 100 * spe, spe);
  caches.play(CacheFlavour::plain, CacheConfig::of(4, 16, CacheReplacement::lru));
  caches.check_values();
  caches.check_counts();
}

TEST_CASE("machine code moves the data that the host's code moves") {
  const auto kind = GENERATE(from_range(cell_kinds()));
  const auto flavour = GENERATE(CacheFlavour::plain, CacheFlavour::checked, CacheFlavour::write_back);
  const auto config = GENERATE(CacheConfig{}, CacheConfig::of(2, 4, CacheReplacement::random),
                               CacheConfig::of(8, 4, CacheReplacement::lru), CacheConfig::off());
  CAPTURE(kind, config.ways, config.sets, config.enabled);
  const auto run_on = [&](const MachineKind& where) {
    ScriptedCaches caches(where, 2, 150);
    for (unsigned spe = 0; spe < 2; ++spe)
      wander_about(caches.script(spe), 800, 50 + spe);
    caches.play(flavour, config);
    caches.check_values();
    return caches;
  };
  run_on(kind).check_transfers_as(run_on({"cell_emu, lockstep", lockstep(1)}));
}

TEST_CASE("without a cache the data are right on every SPU") {
  const auto kind = GENERATE(from_range(kinds()));
  CAPTURE(kind);
  ScriptedCaches caches(kind, 1, 100);
  wander_about(caches.script(), 500, 7);
  caches.play(CacheFlavour::plain, CacheConfig::off());
  caches.check_values();
  caches.check_counts();
}

TEST_CASE("a cache takes the same local store on every SPU") {
  auto kind = GENERATE(from_range(cell_kinds()));
  kind.config.emulation.red_zones = false; // they lie between its allocations
  const auto config = GENERATE(CacheConfig::of(1, 16), CacheConfig::of(2, 8), CacheConfig{},
                               CacheConfig::of(64, 1, CacheReplacement::lru), CacheConfig::off());
  CAPTURE(kind, config.ways, config.sets, config.enabled);
  ScriptedCaches caches(kind, 1, 1);
  caches.play(CacheFlavour::plain, config);
  caches.check_values();
  CHECK(caches.report().local_store_bytes == config.local_store_bytes());
}

TEST_CASE("a cache that does not fit or makes no sense ends the program") {
  const auto kind = GENERATE(from_range(cell_kinds()));
  CAPTURE(kind);
  ScriptedCaches caches(kind, 1, 1);
  caches.play(CacheFlavour::plain, CacheConfig::of(4, 512));
  CHECK_THAT(caches.run().errors[0], Catch::Contains("local store exhausted"));
  caches.play(CacheFlavour::plain, CacheConfig::of(4, 3));
  CHECK_THAT(caches.run().errors[0], Catch::Contains("bad argument"));
}
