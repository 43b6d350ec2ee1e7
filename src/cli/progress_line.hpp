// Shows a job's progress in one line of a terminal.
#pragma once

#include <chrono>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>

namespace celltrace::cli {

/// Estimates when a job is done. Between reports the remaining time runs down with the clock; a report
/// corrects it by a part of its error, since jobs do not advance evenly.
class RemainingTime {
public:
  /// Records the fraction of the job, 0 to 1, that is done after this many seconds. If the first report is
  /// above 0, that part was done before.
  void learn(double fraction, double seconds);
  /// Returns the remaining seconds; nothing before there is a sensible estimate.
  std::optional<double> at(double seconds) const;

private:
  std::optional<double> first_; ///< a fraction
  double fraction_ = 0;         ///< last one reported
  std::optional<double> end_;   ///< estimated end in seconds
};

/// Returns the text of the line: percent, elapsed time and remaining time.
std::string progress_text(double fraction, double seconds, std::optional<double> to_go);

/// Rewrites its line at most ten times a second, starting after `delay`, and erases it at the end. Writes
/// nothing unless `visible`. The line begins with `job`.
class ProgressLine {
public:
  ProgressLine(std::ostream& out, bool visible, std::string job = {}, std::chrono::milliseconds delay = {});
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  void update(double fraction);
  /// Sets the beginning of the line.
  void set_job(std::string job) { job_ = std::move(job); }
  /// Erases the line, until the next update.
  void wipe();

private:
  using Clock = std::chrono::steady_clock;

  std::ostream& out_;
  bool visible_;
  std::string job_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
  RemainingTime remaining_;
};

bool stderr_is_terminal();

} // namespace celltrace::cli
