// How far a job is, in one line of a terminal.
#pragma once

#include <chrono>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>

namespace celltrace::cli {

/// Guesses when a job is done. Between two reports the time to go runs down with the clock, and a report
/// moves it by a part of what it is off: jobs do not go on evenly.
class TimeToGo {
public:
  /// Takes note of how much is done of the job, 0 to 1, after so many seconds. Where the first report is of
  /// more than nothing, that was there before.
  void learn(double fraction, double seconds);
  /// Returns seconds to go; none before a guess makes sense.
  std::optional<double> at(double seconds) const;

private:
  std::optional<double> first_; ///< fraction
  double fraction_ = 0;         ///< last
  std::optional<double> end_;   ///< seconds
};

/// The line's text: percent, time gone, and time to go.
std::string progress_text(double fraction, double seconds, std::optional<double> to_go);

/// Rewrites its line at most ten times a second, from `delay` after its making on, and wipes it at the end.
/// Writes nothing at all if not `visible`. `job` stands in front.
class ProgressLine {
public:
  ProgressLine(std::ostream& out, bool visible, std::string job = {}, std::chrono::milliseconds delay = {});
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  void update(double fraction);
  /// What stands in front from now on.
  void set_job(std::string job) { job_ = std::move(job); }
  /// Makes room for other text, until the next update.
  void wipe();

private:
  using Clock = std::chrono::steady_clock;

  std::ostream& out_;
  bool visible_;
  std::string job_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
  TimeToGo to_go_;
};

/// Whether stderr is a terminal.
bool stderr_is_terminal();

} // namespace celltrace::cli
