// Main memory behind local store: records come through the software cache, other data by DMA. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/local/streams.hpp"
#include "records/report.hpp"

namespace celltrace::kernel {

struct LocalMemory {
  template <class Record> using Kept = const Record;
  template <class Record>
  [[gnu::always_inline]] static const Record* keep(const Record* record, Record& room) {
    room = *record;
    return &room;
  }

  template <class Cache> static const uint8_t* image(Cache&) { return nullptr; }
  /// Reads any record with one copy of the code, as local store is short.
  template <class Record, class Cache>
  static const Record* read_apart(Cache& cache, uint32_t offset, DataKind kind) {
    return reinterpret_cast<const Record*>(read_bytes(cache, offset, sizeof(Record), kind));
  }
  /// Returns the offset of a member of a sequence and prefetches it; `access` is a SceneAccess.
  template <class Access, class Sequence>
  CELLTRACE_ONE_COPY static uint32_t member(Access& access, const Sequence& objects, uint32_t i) {
    const uint32_t object = access.offset_of(objects, i);
    if (i != 0) access.cache().prefetch(object);
    return object;
  }

  template <class Spu, class Object> static void fetch(Spu& spu, Object& to, ea_t from, uint32_t tag) {
    spu.get(&to, from, sizeof(Object), tag);
    spu.wait_all(1u << tag);
  }
  template <class Spu, class T> using StreamReader = LocalStreamReader<Spu, T>;
  template <class Spu, class T> using StreamWriter = LocalStreamWriter<Spu, T>;
  template <class Spu> using SortTarget = LocalSortTarget<Spu>;

  /// DMA for one `Owner`. Each owner has its own copy of the code, as it is in a code module of its own.
  template <class Spu, class Owner> class Transfers {
  protected:
    explicit Transfers(Spu& spu) : spu_(spu) {}
    CELLTRACE_ONE_COPY void fetch(void* ls, ea_t ea, uint32_t bytes) {
      spu_.get(ls, ea, bytes, kTag);
      spu_.wait_all(1u << kTag);
    }
    CELLTRACE_ONE_COPY void send(const void* ls, ea_t ea, uint32_t bytes) { spu_.put(ls, ea, bytes, kTag); }
    template <class Object> [[gnu::always_inline]] void send_object(const Object& object, ea_t ea) {
      send(&object, ea, sizeof(Object));
    }
    template <class Object>
    [[gnu::always_inline]] const Object* found_at(ea_t ea, Object* room, uint32_t bytes = sizeof(Object)) {
      fetch(room, ea, bytes);
      return room;
    }
    void arrive() { spu_.wait_all(1u << kTag); }

  private:
    static constexpr uint32_t kTag = 7;
    Spu& spu_;
  };

private:
  template <class Cache>
  CELLTRACE_ONE_COPY static const uint8_t* read_bytes(Cache& cache, uint32_t offset, uint32_t size,
                                                      DataKind kind) {
    return cache.bytes(offset, size, kind);
  }
};

} // namespace celltrace::kernel
