// Direct main memory: records are read and written in place. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/direct/streams.hpp"
#include "records/report.hpp"

namespace celltrace::kernel {

struct DirectMemory {
  template <class Record> using Kept = const Record&;
  template <class Record> [[gnu::always_inline]] static const Record* keep(const Record* record, Record&) {
    return record;
  }

  template <class Cache> static const uint8_t* image(Cache& cache) {
    return cache.template get<uint8_t>(0, DataKind::object);
  }
  template <class Record, class Cache>
  static const Record* read_apart(Cache& cache, uint32_t offset, DataKind kind) {
    return cache.template get<Record>(offset, kind);
  }
  /// Returns the offset of a member of a sequence and prefetches it; `access` is a SceneAccess.
  template <class Access, class Sequence>
  static uint32_t member(Access& access, const Sequence& objects, uint32_t i) {
    const uint32_t object = access.offset_of(objects, i);
    if (i != 0) access.cache().hint(object);
    return object;
  }

  template <class Spu, class Object> static void fetch(Spu&, Object& to, ea_t from, uint32_t) {
    to = *reinterpret_cast<const Object*>(static_cast<uintptr_t>(from));
  }
  template <class Spu, class T> using StreamReader = DirectStreamReader<T>;
  template <class Spu, class T> using StreamWriter = DirectStreamWriter<T>;
  template <class Spu> using SortTarget = DirectSortTarget;

  /// Copies of memory for one `Owner`. Most copies are so small that DMA would take longer.
  template <class Spu, class Owner> class Transfers {
  protected:
    explicit Transfers(Spu&) {}
    CELLTRACE_ONE_COPY static void fetch(void* ls, ea_t ea, uint32_t bytes) {
      __builtin_memcpy(ls, pointer<void>(ea), bytes);
    }
    CELLTRACE_ONE_COPY static void send(const void* ls, ea_t ea, uint32_t bytes) {
      __builtin_memcpy(pointer<void>(ea), ls, bytes);
    }
    template <class Object> [[gnu::always_inline]] static void send_object(const Object& object, ea_t ea) {
      *pointer<Object>(ea) = object;
    }
    template <class Object>
    [[gnu::always_inline]] static const Object* found_at(ea_t ea, Object*, uint32_t = sizeof(Object)) {
      return pointer<const Object>(ea);
    }
    static void arrive() {}

  private:
    template <class Object> static Object* pointer(ea_t ea) {
      return reinterpret_cast<Object*>(static_cast<uintptr_t>(ea));
    }
  };
};

} // namespace celltrace::kernel
