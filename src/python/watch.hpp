// Who hears of a job's progress in Python, and may break it off.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>

namespace celltrace {

/// Calls a Python function with the finished fraction of a job, and looks for signals, every few
/// milliseconds. What they raise (KeyboardInterrupt) or `False` as the function's result ends the job. Made
/// and destroyed with the interpreter's lock; called without it, by the thread that works.
class Watch {
public:
  /// None: only signals are looked for.
  explicit Watch(pybind11::object function) : function_(std::move(function)) {}

  /// From now on fractions are of the part of the job from `begin` to `end`.
  void set_part(double begin, double end) {
    begin_ = begin;
    end_ = end;
  }
  /// False: the job has to end.
  bool operator()(double fraction);
  /// With the interpreter's lock: raises what ended the job, or celltrace.Cancelled if it ended for want of
  /// it.
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
