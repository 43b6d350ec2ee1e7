// Streams of long arrays in direct main memory, without buffers. Kernel dialect.
#pragma once

#include "kernel/accel/radix_sort.hpp"

namespace celltrace::kernel {

template <class T> class DirectStreamReader {
public:
  template <class Spu> DirectStreamReader(Spu&, uint32_t) {}

  template <class Visit> void for_each(ea_t source, uint32_t count, Visit visit) {
    const T* records = reinterpret_cast<const T*>(static_cast<uintptr_t>(source));
    for (uint32_t i = 0; i < count; ++i)
      visit(records[i], i);
  }
};

template <class T> class DirectStreamWriter {
public:
  template <class Spu>
  DirectStreamWriter(Spu&, uint32_t, ea_t target)
      : records_(reinterpret_cast<T*>(static_cast<uintptr_t>(target))) {}

  void write(const T& record) { records_[count_++] = record; }
  void flush() {}
  uint32_t count() const { return count_; }

private:
  T* records_;
  uint32_t count_ = 0;
};

class DirectSortTarget {
public:
  template <class Spu> DirectSortTarget(Spu&, const uint32_t*, uint32_t* next) : next_(next) {}

  void put(ea_t target, uint32_t bucket, const SortPair& pair) {
    reinterpret_cast<SortPair*>(static_cast<uintptr_t>(target))[next_[bucket]++] = pair;
  }
  void finish(ea_t) {}

private:
  uint32_t* next_;
};

} // namespace celltrace::kernel
