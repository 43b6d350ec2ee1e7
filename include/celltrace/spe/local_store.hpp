// LocalStore: static objects of SPE programs that lie in local store, on the emulated Cell as on a real Cell.
//
//   static celltrace::LocalStore<float[2][2048]> samples;
//   mfc_get((*samples)[0], ea, sizeof (*samples)[0], tag, 0, 0);
//
// A plain static object on a PC would lie in the host's memory, shared by all SPEs, and no DMA command could
// reach it.
#pragma once

#ifndef __SPU__
#include "celltrace/spe/emulated_spu.hpp"

#include <type_traits>
#endif

namespace celltrace {

/// An object of type T in each SPE, aligned to `alignment` (a power of two, at least 16). The object is all
/// zero when the SPE's program first uses it, and gone when the program ends. On a PC, access throws SpeError
/// if no SPE program runs on the thread.
template <class T, unsigned alignment = 128> class LocalStore {
  static_assert(alignment >= 16 && (alignment & (alignment - 1)) == 0, "a power of two, at least 16");

public:
#ifdef __SPU__
  T& operator*() {
    return object_;
  }

private:
  alignas(alignment) T object_;
#else
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>,
                "what DMA moves is plain data");

  T& operator*() const {
    return *static_cast<T*>(cell_emu::Spu::running().local_static(this, sizeof(T), alignment));
  }
#endif

public:
  T* operator->() {
    return &**this;
  }
};

} // namespace celltrace
