// Asking a caller's Progress while SPEs are at work, which an exception of his must not leave behind.
#pragma once

#include "celltrace/render.hpp"

#include <chrono>
#include <exception>

namespace celltrace {

/// How long to wait for SPEs that may have nothing to say, so that whoever wants work broken off is heard
/// soon; and where nobody asks.
constexpr std::chrono::milliseconds kBetweenQuestions(5), kBetweenLooksAtSpes(50);

/// Holds what the function throws until the SPEs are at rest.
class HeldProgress {
public:
  /// `progress` may be empty, and has to outlive this.
  explicit HeldProgress(const Progress& progress) : progress_(progress) {}

  /// Whether to go on. Once it is not, the function is not called again.
  bool ask(double fraction) {
    if (stopped_ || !progress_) return !stopped_;
    try {
      stopped_ = !progress_(fraction);
    } catch (...) {
      failure_ = std::current_exception();
      stopped_ = true;
    }
    return !stopped_;
  }
  /// Calls another function of the caller's; as if it were asked, if that throws.
  template <class Function> void tell(Function function) {
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
