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
/// starts for that thread, regularly ask it whether to go on.
class BuildWatch {
public:
  /// Watches with `go_on`, which gets the finished fraction, is called in this thread only, and may be empty.
  /// If `go_on` returns false the computation ends with Cancelled; exceptions of `go_on` pass through.
  /// `go_on` has to outlive this object.
  explicit BuildWatch(const std::function<bool(double fraction)>& go_on)
      : go_on_(go_on), thread_(std::this_thread::get_id()),
        outer_(std::exchange(current_, go_on ? this : nullptr)) {}
  BuildWatch(const BuildWatch&) = delete;
  BuildWatch& operator=(const BuildWatch&) = delete;
  ~BuildWatch() { current_ = outer_; }

  /// Returns whether this watch has ended the computation.
  bool has_stopped() const { return stopped_.load(std::memory_order_relaxed); }

  /// Throws if the computation is to end.
  static void look() {
    if (current_) current_->ask();
  }
  /// Calls look() for some numbers `i` of a loop over many things: cheap for each of them.
  static void look_at(std::size_t i) {
    if (i % kBetweenLooks == 0) look();
  }
  /// Reports the fraction that is finished from here on.
  static void reach(double fraction) {
    if (current_) current_->fraction_ = fraction;
    look();
  }

  /// Returns the watch of this thread, or null; follow() gives another thread the watch while it works for
  /// this one.
  static BuildWatch* current() { return current_; }
  static void follow(BuildWatch* watch) { current_ = watch; }

private:
  static constexpr std::size_t kBetweenLooks = 8192;

  void ask() {
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
  BuildWatch* const outer_; ///< watch of the computation whose `go_on` has begun this one
  double fraction_ = 0;
  std::atomic<bool> stopped_ = false;
  static inline thread_local BuildWatch* current_ = nullptr;
};

} // namespace celltrace
