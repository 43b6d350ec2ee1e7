// What the PPE sleeps on until an SPE has something for it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace celltrace::cell_emu {

/// Thread safety: all members from any thread.
class PpeBell {
public:
  /// An outbound mailbox has been filled.
  void ring_mail() {
    { const std::lock_guard lock(mutex_); }
    rung_.notify_all();
  }
  /// An SPE has stopped.
  void ring_stop() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    }
    rung_.notify_all();
  }
  /// Sleeps until an SPE has stopped since the last call or `has_mail()` is true; false on timeout.
  template <class HasMail> bool wait_for(std::chrono::milliseconds timeout, HasMail has_mail) {
    std::unique_lock lock(mutex_);
    const bool rang = rung_.wait_for(lock, timeout, [&] { return stopped_ || has_mail(); });
    stopped_ = false;
    return rang;
  }

private:
  std::mutex mutex_;
  std::condition_variable rung_;
  bool stopped_ = false;
};

} // namespace celltrace::cell_emu
