// Locks that make DMA on a line of the main storage domain atomic. Many lines share a lock, chosen by
// address, so that SPEs that use different data rarely compete.
#pragma once

#include "celltrace/spe/types.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace celltrace::cell_emu {

/// A spin lock for critical sections of some hundred nanoseconds.
class SpinLock {
public:
  void lock() {
    for (unsigned tries = 0; locked_.exchange(true, std::memory_order_acquire); ++tries)
      wait(tries);
  }
  void unlock() { locked_.store(false, std::memory_order_release); }

private:
  void wait(unsigned& tries) {
    // If there are more SPEs than processors, the thread that holds the lock may be asleep.
    while (locked_.load(std::memory_order_relaxed))
      if (++tries % 64 == 0) std::this_thread::yield();
  }

  std::atomic<bool> locked_{false};
};

/// The lock of all lines that map to this stripe, and the number of SPEs' reservations of these lines.
struct alignas(64) Stripe {
  SpinLock lock;
  std::uint32_t reservations = 0; ///< guarded by lock
};

class LineLocks {
public:
  /// Consecutive bytes under one lock: several lines, so that a long transfer takes few locks.
  static constexpr std::uint32_t kSpan = 8 * kLineBytes;

  Stripe& of(ea_t ea) { return stripes_[(ea / kSpan) % kStripes]; }

private:
  static constexpr std::size_t kStripes = 1024;
  std::array<Stripe, kStripes> stripes_;
};

} // namespace celltrace::cell_emu
