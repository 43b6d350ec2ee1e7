// Progress and cancellation of long computations on the host.
#pragma once

#include "celltrace/error.hpp"

#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <utility>

namespace celltrace {

/// While an object of this class lives, long computations of its thread, and of threads that for_each_part()
/// starts for that thread, regularly report to the object and ask whether to go on.
class ProgressMonitor {
public:
  /// Makes a monitor that calls `go_on`, which gets the finished fraction, is called in this thread only, and
  /// may be empty. If `go_on` returns false the computation ends with Cancelled; exceptions of `go_on` pass
  /// through. `go_on` has to outlive this object.
  explicit ProgressMonitor(const std::function<bool(double fraction)>& go_on)
      : go_on_(go_on), thread_(std::this_thread::get_id()),
        outer_(std::exchange(current_, go_on ? this : nullptr)) {}
  ProgressMonitor(const ProgressMonitor&) = delete;
  ProgressMonitor& operator=(const ProgressMonitor&) = delete;
  ~ProgressMonitor() { current_ = outer_; }

  /// Returns whether this monitor has ended the computation.
  bool has_stopped() const { return stopped_.load(std::memory_order_relaxed); }

  /// Throws Cancelled, or an exception of `go_on`, if the computation is to end.
  static void check_cancelled() {
    if (current_) current_->check();
  }
  /// Calls check_cancelled() for every kCheckInterval-th index `i` of a long loop, at little cost to each
  /// iteration.
  static void check_cancelled(std::size_t i) {
    if (i % kCheckInterval == 0) check_cancelled();
  }
  /// Reports the fraction that is finished from here on.
  static void report(double fraction) {
    if (current_) current_->fraction_ = fraction;
    check_cancelled();
  }

  /// Returns the monitor of this thread, or null. A thread that works for this thread passes the monitor to
  /// adopt().
  static ProgressMonitor* current() { return current_; }
  static void adopt(ProgressMonitor* monitor) { current_ = monitor; }

private:
  static constexpr std::size_t kCheckInterval = 8192;

  void check() {
    if (has_stopped()) throw Cancelled();
    if (std::this_thread::get_id() != thread_) return;
    try {
      if (go_on_(fraction_)) return;
    } catch (...) {
      stopped_.store(true, std::memory_order_relaxed);
      throw;
    }
    stopped_.store(true, std::memory_order_relaxed);
    throw Cancelled();
  }

  const std::function<bool(double fraction)>& go_on_;
  const std::thread::id thread_;
  ProgressMonitor* const outer_; ///< monitor of the computation whose `go_on` has begun this one
  double fraction_ = 0;
  std::atomic<bool> stopped_ = false;
  static inline thread_local ProgressMonitor* current_ = nullptr;
};

} // namespace celltrace
