// Wall clock and processor time of a stretch of work.
#pragma once

#include <chrono>
#include <ctime>

namespace celltrace::compare {

/// Seconds on the wall clock, and of the processor for all threads of the process that worked.
struct Seconds {
  double wall = 0;
  double processor = 0;

  Seconds operator+(const Seconds& other) const { return {wall + other.wall, processor + other.processor}; }
};

/// Runs from its construction on.
class Stopwatch {
public:
  Seconds elapsed() const { return {wall_now() - wall_, processor_now() - processor_}; }

private:
  static double wall_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  static double processor_now() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  double wall_ = wall_now();
  double processor_ = processor_now();
};

} // namespace celltrace::compare
