// The cache that can be written to.
#include "fake_spu.hpp"
#include "memory.hpp"
#include "scripted_caches.hpp"

#include "celltrace/cache.hpp"

#include <catch2/catch.hpp>

#include <cstring>
#include <memory>
#include <random>

using namespace celltrace;
using namespace celltrace::test;

namespace {

using Cache = WriteBackCache<FakeSpu>;

std::uint8_t& byte(Memory& memory, std::uint32_t offset) {
  return reinterpret_cast<std::uint8_t*>(&memory.word(offset & ~3u))[offset & 3];
}

struct alignas(16) Block {
  std::uint32_t words[4];
};
struct Whole {
  std::uint32_t words[kLineBytes / 4];
};

} // namespace

TEST_CASE("what was written is read, and is in main memory after a flush") {
  const auto config =
      GENERATE(CacheConfig::of(1, 1), CacheConfig::of(1, 8), CacheConfig::of(4, 4),
               CacheConfig::of(4, 4, CacheReplacement::random), CacheConfig::of(8, 2, CacheReplacement::lru),
               CacheConfig::of(16, 1), CacheConfig::off());
  CAPTURE(config.ways, config.sets, config.replacement, config.enabled);
  Memory memory(40), expected(40);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, config, memory.base());
  std::mt19937 random(config.ways);
  std::uint32_t wrong = 0;
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 500; ++i) {
      const std::uint32_t offset = random() % memory.bytes();
      const std::uint32_t word = offset & ~3u;
      switch (random() % 8) {
      case 0:
        cache.write(offset, static_cast<std::uint8_t>(i), 1u);
        byte(expected, offset) = static_cast<std::uint8_t>(i);
        break;
      case 1:
        expected.word(word) = static_cast<std::uint32_t>(random());
        cache.write(word, expected.word(word), 1u);
        break;
      case 2: {
        const Block block = {{offset, 2, 3, 4}};
        cache.write(offset & ~15u, block, 1u);
        std::memcpy(&expected.word(offset & ~15u), &block, sizeof block);
        break;
      }
      case 3:
        cache.prefetch(offset);
        break;
      default:
        wrong += cache.word(word, 0u) != expected.word(word);
      }
    }
    if (round % 4 == 0)
      cache.invalidate_all();
    else
      cache.flush();
    for (std::uint32_t offset = 0; offset < memory.bytes(); offset += 4)
      wrong += memory.word(offset) != expected.word(offset);
  }
  CHECK(wrong == 0);
  cache.invalidate_all();
  CHECK(spu->in_flight() == 0);
  CHECK(cache.written_back() > 0);
  CHECK(cache.counters(1).hits + cache.counters(1).misses > 0);
}

TEST_CASE("bytes that others write to a line are kept") {
  Memory memory(2);
  const auto config = GENERATE(CacheConfig::of(4, 4), CacheConfig::off());
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, config, memory.base());
  cache.write(8, std::uint8_t{1}, 0u);
  byte(memory, 9) = 2;
  std::uint8_t others = 0;
  spu->after_getllar = [&] {
    // Another SPE is quicker, twice.
    if (others == 2) return;
    ++others;
    byte(memory, 100u + others) = others;
  };
  cache.flush();
  CHECK(byte(memory, 8) == 1);
  CHECK(byte(memory, 9) == 2);
  CHECK(byte(memory, 101) == 1);
  CHECK(byte(memory, 102) == 2);
  CHECK(cache.written_back() == 1);
  cache.flush();
  CHECK(cache.written_back() == 1);
}

TEST_CASE("a line that was written as a whole leaves by a put") {
  Memory memory(1);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, CacheConfig::of(1, 1), memory.base());
  spu->after_getllar = [] { FAIL("an atomic update"); };
  Whole whole{};
  for (std::uint32_t i = 0; i < kLineBytes / 4; ++i)
    whole.words[i] = i;
  cache.write(0, whole, 0u);
  cache.flush();
  CHECK(memory.word(124) == 31);
  CHECK(spu->transfers() == 2);
}

TEST_CASE("a synchronize keeps what was written and fetches the rest again") {
  Memory memory(2);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, CacheConfig{}, memory.base());
  cache.write(0, 11u, 0u);
  memory.word(4) = 22;
  CHECK(cache.word(4, 0u) != 22);
  cache.synchronize(0, 8);
  CHECK(cache.word(4, 0u) == 22);
  CHECK(cache.word(0, 0u) == 11);
  CHECK(memory.word(0) == 11);
  cache.write(0, 12u, 0u);
  cache.synchronize_all();
  cache.prefetch(0);
  CHECK(cache.word(0, 0u) == 12);
}

TEST_CASE("a cache that can be written to takes the local store that it says") {
  const auto config =
      GENERATE(CacheConfig::of(1, 16), CacheConfig::of(4, 8), CacheConfig::of(64, 1), CacheConfig::off());
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, config, 0);
  CHECK(spu->local_store_used() == Cache::local_store_bytes(config));
}

namespace {

/// Reads and writes bytes, words, blocks and lines.
void write_at_random(CacheScript& script, unsigned length, unsigned seed) {
  std::mt19937 random(seed);
  for (unsigned i = 0; i < length; ++i) {
    const auto offset = static_cast<std::uint32_t>(random() % script.bytes());
    const auto value = static_cast<std::uint32_t>(random());
    switch (random() % 12) {
    case 0:
      script.write_byte(offset, value, 1);
      break;
    case 1:
      script.write_word(offset & ~3u, value, 1);
      break;
    case 2:
      script.write_block(offset & ~15u, value, 2);
      break;
    case 3:
      script.write_line(offset & ~127u, value, 3);
      break;
    case 4:
      script.add(CacheStep::prefetch, offset);
      break;
    case 5:
      script.read_byte(offset);
      break;
    case 6:
      script.read_block(offset & ~15u);
      break;
    case 7:
      script.read_line(offset & ~127u);
      break;
    default:
      script.read(offset & ~3u);
    }
    if (i % 300 == 299) script.add(i % 900 == 899 ? CacheStep::invalidate_all : CacheStep::flush);
  }
  script.add(CacheStep::invalidate_all);
}

} // namespace

TEST_CASE("what was written is read, and is in main memory in the end, on every SPU") {
  const auto kind = GENERATE(from_range(kinds_for(cache_scripts_program())));
  const auto config =
      GENERATE(CacheConfig::of(1, 1), CacheConfig::of(1, 8), CacheConfig::of(4, 4),
               CacheConfig::of(4, 4, CacheReplacement::random), CacheConfig::of(8, 2, CacheReplacement::lru),
               CacheConfig::of(16, 1), CacheConfig::off());
  CAPTURE(kind, config.ways, config.sets, config.enabled);
  ScriptedCaches caches(kind, 1, 40);
  write_at_random(caches.script(), 3000, config.ways);
  caches.play(CacheFlavour::write_back, config);
  caches.check_values();
  caches.check_counts();
  caches.check_memory();
  if (!kind.is_native()) CHECK(caches.report().written_back > 0);
}

TEST_CASE("SPEs that write different bytes of the same lines lose none") {
  const auto kind = GENERATE(from_range(kinds_for(cache_scripts_program())));
  const std::uint32_t spes = GENERATE(2u, 5u, 8u);
  CAPTURE(kind, spes);
  ScriptedCaches caches(kind, spes, 16);
  const auto byte_of = [&](std::uint32_t offset, std::uint32_t round) {
    return (offset * 7 + offset % spes + 3 * round) & 0xFF;
  };
  for (std::uint32_t spe = 0; spe < spes; ++spe) {
    CacheScript& script = caches.script(spe);
    for (std::uint32_t round = 0; round < 3; ++round)
      for (std::uint32_t offset = spe; offset < script.bytes(); offset += spes) {
        if (round != 0) script.read_byte(offset);
        script.write_byte(offset, byte_of(offset, round));
      }
    script.add(CacheStep::flush);
  }
  caches.play(CacheFlavour::write_back, CacheConfig::of(2, 2));
  caches.check_values();
  caches.check_counts();
  std::uint32_t wrong = 0;
  for (std::uint32_t offset = 0; offset < caches.script().bytes(); ++offset)
    wrong += caches.byte(offset) != byte_of(offset, 2);
  CHECK(wrong == 0);
}
