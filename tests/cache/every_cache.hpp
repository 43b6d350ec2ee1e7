// Uses all that a software cache can do, to see that it compiles for the SPU. Kernel dialect.
#pragma once

#include "celltrace/cache.hpp"

namespace celltrace::test {

enum class CacheKind : uint32_t { word, block };

struct alignas(16) CacheBlock {
  uint32_t words[4];
};

template <class Cache> uint32_t read_everything(Cache& cache) {
  const uint32_t offsets[] = {0, 128, 4096};
  cache.fetch(offsets, 3);
  cache.prefetch(640);
  const auto block = cache.template get<CacheBlock>(32, CacheKind::block);
  uint32_t sum = block->words[1];
  for (WordRun run(cache, 4, 100, CacheKind::word); !run.empty();)
    sum += run.next();
  sum += cache.word(12, CacheKind::word) + cache.template copy<CacheBlock>(64, CacheKind::block).words[2];
  const auto words = cache.words(Cache::Lanes::splat(16), 0xF0F1, CacheKind::word);
  sum += (words == Cache::Lanes::splat(0)).bits();
  cache.synchronize(0, 400);
  cache.synchronize_all();
  cache.invalidate_all();
  sum += cache.counters(CacheKind::word).hits;
  cache.reset_counters();
  return sum;
}

template <class Spu> void every_cache(Spu& spu, ea_t argument) {
  CacheConfig config;
  config.sets = 32;
  SoftwareCache<Spu, CacheKind> plain(spu, config, argument);
  SoftwareCache<Spu, CacheKind, CheckedCacheOptions> checked(spu, config, argument);
  WriteBackCache<Spu, CacheKind> written(spu, config, argument);
  uint32_t sum = read_everything(plain) + read_everything(checked) + read_everything(written);
  written.write(16, CacheBlock{{1, 2, 3, sum}}, CacheKind::block);
  written.write(5, static_cast<uint8_t>(3), CacheKind::word);
  written.flush();
  sum += written.written_back();
  spu.write_out_mailbox(sum);
}

} // namespace celltrace::test
