// Calls a caller's Progress while SPEs are at work, and keeps its exception from leaving them at work.
#pragma once

#include "celltrace/render.hpp"

#include <chrono>
#include <exception>

namespace celltrace {

/// Longest times to wait for messages of SPEs: short if the caller may end the work, else long.
constexpr std::chrono::milliseconds kCancellablePollInterval(5), kPollInterval(50);

/// Calls the caller's function, and holds its exception until the SPEs are idle.
class HeldProgress {
public:
  /// Refers to `progress`, which may be empty and must outlive this object.
  explicit HeldProgress(const Progress& progress) : progress_(progress) {}

  /// Returns whether to go on. Once the result is false, the function is not called again.
  bool report(double fraction) {
    if (stopped_ || !progress_) return !stopped_;
    try {
      stopped_ = !progress_(fraction);
    } catch (...) {
      failure_ = std::current_exception();
      stopped_ = true;
    }
    return !stopped_;
  }
  /// Calls another function of the caller's; its exception stops the work as an exception in report() does.
  template <class Function> void call(Function function) {
    if (stopped_) return;
    try {
      function();
    } catch (...) {
      failure_ = std::current_exception();
      stopped_ = true;
    }
  }
  bool stopped() const { return stopped_; }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

private:
  const Progress& progress_;
  bool stopped_ = false;
  std::exception_ptr failure_;
};

} // namespace celltrace
