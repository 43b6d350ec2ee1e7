// Doorbell: the PPE sleeps on it while its SPEs work.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace celltrace::native {

/// A condition variable for predicates over atomics that many SPEs change. Thread safety: all members from
/// any thread.
class Doorbell {
public:
  /// Wakes the sleeping thread, which checks its predicate again.
  void ring() noexcept {
    // The lock makes sure that the sleeping thread either sees the change in its next check, or already
    // sleeps and gets this ring.
    { const std::lock_guard lock(mutex_); }
    changed_.notify_all();
  }
  /// Rings because an SPE has stopped.
  void ring_for_stop() noexcept {
    stopped_.store(true, std::memory_order_release);
    ring();
  }
  /// Returns true if an SPE has stopped since the last call.
  bool take_stop() noexcept { return stopped_.exchange(false); }
  /// Sleeps until `ready()` or the timeout; returns the last value of ready().
  template <class Ready> bool wait(std::chrono::milliseconds timeout, Ready ready) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, timeout, ready);
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> stopped_{false};
};

} // namespace celltrace::native
