#include "fake_spu.hpp"
#include "memory.hpp"
#include "model.hpp"

#include "celltrace/cache.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <random>

using namespace celltrace;
using namespace celltrace::test;

namespace {

enum class Kind { list, object };
using Cache = SoftwareCache<FakeSpu, Kind>;

struct Shape {
  std::uint32_t ways;
  std::uint32_t sets;
};

CacheConfig configuration(Shape shape, CacheReplacement replacement) {
  CacheConfig config;
  config.ways = shape.ways;
  config.sets = shape.sets;
  config.replacement = replacement;
  return config;
}

HaltCode halt_code(const CacheConfig& config, ea_t base = 0) {
  const auto spu = std::make_unique<FakeSpu>();
  try {
    Cache cache(*spu, config, base);
  } catch (HaltCode code) {
    return code;
  }
  FAIL("the SPE was not halted");
  return HaltCode::internal_error;
}

} // namespace

TEST_CASE("a cache hits and misses as its model does, and its data are right") {
  const auto shape = GENERATE(Shape{1, 1}, Shape{1, 16}, Shape{2, 8}, Shape{4, 1}, Shape{4, 8}, Shape{4, 128},
                              Shape{2, 1}, Shape{8, 1}, Shape{8, 64}, Shape{16, 4}, Shape{64, 1});
  const auto replacement = GENERATE(CacheReplacement::random, CacheReplacement::fifo, CacheReplacement::lru);
  const auto tag_count = GENERATE(1u, 8u);
  CacheConfig config = configuration(shape, replacement);
  config.tag_count = tag_count;
  Memory memory(3 * config.lines() + 5);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, config, memory.base());
  CacheModel model(config);
  std::mt19937 random(shape.ways * 1000 + shape.sets);

  std::uint32_t hits = 0, misses = 0, wrong = 0;
  std::uint32_t offset = 0;
  for (int i = 0; i < 20'000; ++i) {
    offset = wander(offset, memory.bytes(), random);
    const auto choice = random() % 256;
    if (choice < 40) {
      cache.prefetch(offset);
      model.prefetch(offset);
    } else if (choice < 44) {
      const std::uint32_t bytes = std::min<std::uint32_t>(random() % 600, memory.bytes() - offset);
      for (std::uint32_t at = offset; at < offset + bytes / 4 * 4; at += 4)
        memory.word(at) += 77;
      if (offset % kLineBytes + bytes <= kLineBytes && bytes != 0)
        cache.synchronize_line(offset / kLineBytes * kLineBytes);
      else
        cache.synchronize(offset, bytes);
      model.synchronize(offset, bytes);
    } else if (choice == 44) {
      cache.synchronize_all();
      model.synchronize(0, memory.bytes());
    } else if (choice == 45 && random() % 16 == 0) {
      cache.invalidate_all();
      model.invalidate_all();
      CHECK(spu->in_flight() == 0);
    } else {
      ++(model.read(offset) ? hits : misses);
      wrong += cache.word(offset, Kind::object) != memory.word(offset);
    }
  }
  CHECK(wrong == 0);
  CHECK(cache.counters(Kind::object).hits == hits);
  CHECK(cache.counters(Kind::object).misses == misses);
  CHECK(cache.counters(Kind::list).hits == 0);
  CHECK(hits > 0);
  CHECK(misses > 0);
}

TEST_CASE("a cache takes the local store that its configuration says") {
  const auto shape = GENERATE(Shape{1, 16}, Shape{2, 8}, Shape{4, 128}, Shape{64, 1});
  const auto enabled = GENERATE(true, false);
  CacheConfig config = configuration(shape, CacheReplacement::lru);
  config.enabled = enabled;
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, config, 0);
  CHECK(spu->local_store_used() == config.local_store_bytes());
}

TEST_CASE("the least recently used line makes room, or the first come") {
  Memory memory(6);
  const auto replacement = GENERATE(CacheReplacement::lru, CacheReplacement::fifo);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, configuration({4, 1}, replacement), memory.base());
  for (const std::uint32_t line : {0u, 1u, 2u, 3u, 0u, 4u, 0u})
    cache.word(line * kLineBytes, Kind::list);
  CHECK(cache.counters(Kind::list).hits == (replacement == CacheReplacement::lru ? 2 : 1));
}

TEST_CASE("with lru a pointer survives as many calls as there are other ways") {
  Memory memory(5);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, configuration({4, 1}, CacheReplacement::lru), memory.base());
  for (std::uint32_t line = 0; line < 4; ++line)
    cache.word(line * kLineBytes, Kind::list);
  const std::uint32_t* first = cache.get<std::uint32_t>(4, Kind::object);
  cache.word(4 * kLineBytes, Kind::list);
  cache.word(1 * kLineBytes, Kind::list);
  cache.word(2 * kLineBytes, Kind::list);
  CHECK(*first == memory.word(4));
}

TEST_CASE("lines that were read are read again only after a synchronize") {
  Memory memory(4);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, CacheConfig{}, memory.base());
  const std::uint32_t before = cache.word(kLineBytes, Kind::object);
  cache.word(2 * kLineBytes, Kind::object);
  memory.word(kLineBytes) = before + 1;
  CHECK(cache.word(kLineBytes, Kind::object) == before);
  cache.synchronize(kLineBytes, 4);
  CHECK(cache.word(kLineBytes, Kind::object) == before + 1);
  CHECK(cache.word(2 * kLineBytes, Kind::object) == memory.word(2 * kLineBytes));
  CHECK(spu->transfers() == 3);
}

TEST_CASE("a prefetch does not wait, and the read that follows is a hit") {
  Memory memory(4);
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, CacheConfig{}, memory.base());
  cache.prefetch(kLineBytes + 8);
  cache.prefetch(kLineBytes + 12);
  CHECK(spu->in_flight() == 1);
  CHECK(cache.copy<std::uint32_t>(kLineBytes + 8, Kind::object) == memory.word(kLineBytes + 8));
  CHECK(spu->in_flight() == 0);
  CHECK(spu->transfers() == 1);
  CHECK(cache.counters(Kind::object).hits == 1);
  CHECK(cache.counters(Kind::object).misses == 0);
}

TEST_CASE("an object up to a line long comes whole") {
  struct alignas(kLineBytes) Object {
    std::uint32_t words[kLineBytes / 4];
  };
  Memory memory(3);
  const auto enabled = GENERATE(true, false);
  CacheConfig config;
  config.enabled = enabled;
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, config, memory.base());
  const Object* object = cache.get<Object>(2 * kLineBytes, Kind::object);
  for (std::uint32_t i = 0; i < kLineBytes / 4; ++i)
    CHECK(object->words[i] == memory.word(2 * kLineBytes + 4 * i));
}

TEST_CASE("without a cache every read is a transfer of the quadwords it touches") {
  Memory memory(4);
  CacheConfig config;
  config.enabled = false;
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, config, memory.base());
  struct alignas(16) Block {
    std::uint32_t words[12];
  };
  CHECK(cache.word(kLineBytes + 20, Kind::list) == memory.word(kLineBytes + 20));
  CHECK(cache.word(kLineBytes + 20, Kind::list) == memory.word(kLineBytes + 20));
  CHECK(spu->bytes() == 32);
  CHECK(cache.get<Block>(80, Kind::list)->words[11] == memory.word(124));
  cache.prefetch(0);
  cache.synchronize_all();
  cache.invalidate_all();
  CHECK(spu->transfers() == 3);
  CHECK(spu->bytes() == 80);
  CHECK(cache.counters(Kind::list).hits == 0);
  CHECK(cache.counters(Kind::list).misses == 3);
  cache.reset_counters();
  CHECK(cache.counters(Kind::list).misses == 0);
}

TEST_CASE("the last lines of the 32-bit offsets are lines like others") {
  Memory memory(2);
  const ea_t base = memory.base() - 0xFFFFFF00u;
  const auto spu = std::make_unique<FakeSpu>();
  Cache cache(*spu, configuration({2, 2}, CacheReplacement::fifo), base);
  for (int i = 0; i < 2; ++i) {
    CHECK(cache.word(0xFFFFFFFCu, Kind::list) == memory.word(252));
    CHECK(cache.word(0xFFFFFF00u, Kind::list) == memory.word(0));
  }
  CHECK(cache.counters(Kind::list).hits == 2);
}

TEST_CASE("shapes that are no cache are refused") {
  const auto shape = GENERATE(Shape{3, 8}, Shape{8, 512}, Shape{0, 1}, Shape{4, 0}, Shape{4, 12},
                              Shape{4, 4096}, Shape{12, 1}, Shape{4096, 1}, Shape{4, 0x80000000u});
  const CacheConfig config = configuration(shape, CacheReplacement::random);
  CHECK_FALSE(config.valid());
  CHECK(halt_code(config) == HaltCode::bad_argument);
}

TEST_CASE("tags that do not exist, an odd base and too little local store are refused") {
  CacheConfig config;
  config.first_tag = 28;
  CHECK(halt_code(config) == HaltCode::bad_argument);
  config.first_tag = 0;
  config.tag_count = 3;
  CHECK(halt_code(config) == HaltCode::bad_argument);
  CHECK(halt_code(CacheConfig{}, 64) == HaltCode::bad_argument);
  CHECK(halt_code(configuration({4, 512}, CacheReplacement::random)) == HaltCode::local_store_exhausted);
}

namespace {
struct DirectSpu {
  static constexpr bool direct_memory = true;
  using simd = HostSimd<BaselineArch>;
};
} // namespace

TEST_CASE("with direct memory a read is a read") {
  Memory memory(2);
  DirectSpu spu;
  SoftwareCache<DirectSpu> cache(spu, CacheConfig{}, memory.base());
  cache.prefetch(0);
  CHECK(cache.get<std::uint32_t>(132, 0) == &memory.word(132));
  CHECK(cache.word(8, 0) == memory.word(8));
  cache.synchronize(0, 4);
  cache.synchronize_all();
  cache.invalidate_all();
  CHECK(cache.counters(0).hits + cache.counters(0).misses == 0);
}
