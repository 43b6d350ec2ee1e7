// What the PPE sleeps on while its SPEs work.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace celltrace::native {

/// A condition variable for predicates over atomics that many SPEs change. Thread safety: any thread calls
/// anything.
class Doorbell {
public:
  /// Wakes the sleeper so that it looks again.
  void ring() noexcept {
    // Taking the lock orders the change before the sleeper's next look, or the ring after the start of its
    // sleep.
    { const std::lock_guard lock(mutex_); }
    changed_.notify_all();
  }
  /// Sleeps until `ready()` or the timeout; the last value of ready().
  template <class Ready> bool wait(std::chrono::milliseconds timeout, Ready ready) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, timeout, ready);
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
};

} // namespace celltrace::native
