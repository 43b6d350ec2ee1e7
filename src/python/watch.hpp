// Reports a job's progress to Python, which may cancel the job.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>

namespace celltrace {

/// Calls a Python function with the finished fraction of a job, and checks for signals, every few
/// milliseconds. If these raise an exception (KeyboardInterrupt) or the function returns `False`, the job
/// ends. Constructed and destroyed with the interpreter's lock; called without it, by the thread that works.
class Watch {
public:
  /// Makes a watch. None: only checks for signals.
  explicit Watch(pybind11::object function) : function_(std::move(function)) {}

  /// Scales later fractions to the part of the job from `begin` to `end`.
  void set_part(double begin, double end) {
    begin_ = begin;
    end_ = end;
  }
  /// Returns false if the job has to end.
  bool operator()(double fraction);
  /// Raises the exception that ended the job, or celltrace.Cancelled if the function ended an incomplete one.
  /// Called with the interpreter's lock.
  void check(bool is_complete) const;
  bool has_ended() const { return ended_; }

private:
  static constexpr std::chrono::milliseconds kPeriod{20};

  pybind11::object function_;
  double begin_ = 0, end_ = 1;
  std::chrono::steady_clock::time_point last_{};
  bool ended_ = false;
  std::exception_ptr error_;
};

} // namespace celltrace
