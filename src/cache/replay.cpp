// Replays with the cache itself on an SPU that has only local store.
#include "celltrace/cache/replay.hpp"

#include "celltrace/cache.hpp"
#include "celltrace/error.hpp"
#include "celltrace/spe/simd_host.hpp"

#include <new>
#include <stdexcept>

namespace celltrace {

using cache_trace::Operation;

namespace {

/// An SPU that counts transfers without moving data.
class CountingSpu {
public:
  static constexpr bool direct_memory = false;
  using simd = HostSimd<BaselineArch>;

  explicit CountingSpu(std::size_t bytes) : store_(bytes / kLineBytes + kSlack) {}

  template <class T> T* allocate(std::uint32_t count = 1, std::uint32_t alignment = kLineBytes) {
    next_ = (next_ + alignment - 1) & ~(std::size_t{alignment} - 1);
    const std::size_t at = next_;
    next_ += count * sizeof(T);
    if (next_ > store_.size() * kLineBytes) halt(HaltCode::local_store_exhausted);
    // An object may be longer than a line, so the check is against all of the store.
    T* objects = reinterpret_cast<T*>(reinterpret_cast<std::byte*>(store_.data()) + at);
    for (std::uint32_t i = 0; i < count; ++i)
      new (static_cast<void*>(objects + i)) T();
    return objects;
  }
  void get(void*, ea_t, std::uint32_t, std::uint32_t) { ++fetched_; }
  void put(const void*, ea_t, std::uint32_t, std::uint32_t) {}
  void getllar(void*, ea_t) {}
  bool putllc(const void*, ea_t) { return true; }
  void wait_all(std::uint32_t) {}
  void compute(const ScalarWork&) {}
  void record(const void*, std::uint32_t) {}
  [[noreturn]] void halt(HaltCode code) { throw std::logic_error(to_text(code)); }

  std::uint64_t fetched() const { return fetched_; }
  void reset_fetched() { fetched_ = 0; }

private:
  static constexpr std::size_t kSlack = 8; ///< lines, for alignment
  struct alignas(kLineBytes) Line {
    std::byte bytes[kLineBytes];
  };

  std::vector<Line> store_;
  std::size_t next_ = 0;
  std::uint64_t fetched_ = 0;
};

class Replay {
public:
  explicit Replay(const CacheConfig& shape) : spu_(Cache::local_store_bytes(shape)), cache_(spu_, shape, 0) {}

  void access(const CacheRequest& request) {
    const std::uint32_t offset = request.line * kLineBytes;
    switch (request.operation) {
    case Operation::read:
      for (std::uint32_t i = 0; i < request.count; ++i)
        cache_.get<std::uint8_t>(offset, request.kind);
      return;
    case Operation::write:
      for (std::uint32_t i = 0; i < request.count; ++i)
        cache_.write(offset, std::uint8_t{0}, request.kind);
      return;
    case Operation::prefetch:
      return cache_.prefetch(offset);
    case Operation::synchronize:
      // One byte less, because there may be no offset behind the last line.
      return cache_.synchronize(offset, request.count * kLineBytes - 1);
    case Operation::synchronize_all:
      return cache_.synchronize_all();
    case Operation::invalidate_all:
      return cache_.invalidate_all();
    case Operation::flush:
      return cache_.flush();
    case Operation::reset_counters:
      return reset();
    case Operation::begin:
    case Operation::end:
      break;
    }
    throw InputError("cache trace: a request that is none");
  }

  ReplayResult result() const {
    ReplayResult result;
    for (std::uint32_t kind = 0; kind < cache_trace::kKinds; ++kind) {
      const CacheCounters counters = cache_.counters(kind);
      result.kinds[kind] = {counters.hits, counters.misses};
    }
    result.fetched = spu_.fetched();
    result.written_back = cache_.written_back() - written_back_before_;
    return result;
  }

private:
  using Cache = WriteBackCache<CountingSpu>;

  void reset() {
    cache_.reset_counters();
    spu_.reset_fetched();
    written_back_before_ = cache_.written_back();
  }

  CountingSpu spu_;
  Cache cache_;
  std::uint64_t written_back_before_ = 0;
};

} // namespace

ReplayResult::Counters ReplayResult::total() const {
  Counters total;
  for (const Counters& kind : kinds) {
    total.hits += kind.hits;
    total.misses += kind.misses;
  }
  return total;
}

double ReplayResult::hit_rate() const {
  const Counters all = total();
  const std::uint64_t references = all.hits + all.misses;
  return references == 0 ? 0 : static_cast<double>(all.hits) / static_cast<double>(references);
}

ReplayResult operator+(ReplayResult a, const ReplayResult& b) {
  for (std::size_t kind = 0; kind < a.kinds.size(); ++kind) {
    a.kinds[kind].hits += b.kinds[kind].hits;
    a.kinds[kind].misses += b.kinds[kind].misses;
  }
  a.fetched += b.fetched;
  a.written_back += b.written_back;
  return a;
}

ReplayResult replay(const CacheTrace& trace, const CacheConfig& shape) {
  if (!shape.valid()) throw InputError("cache trace: no cache can have this shape");
  Replay replay(shape);
  for (const CacheRequest& request : trace.requests)
    replay.access(request);
  return replay.result();
}

} // namespace celltrace
