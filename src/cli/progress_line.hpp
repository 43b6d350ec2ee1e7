// How far a job is, in one line of a terminal.
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>
#include <utility>

namespace celltrace::cli {

/// The line's text: percent, time gone, and time to go once a guess makes sense. `fraction` is 0..1.
std::string progress_text(double fraction, std::chrono::duration<double> elapsed);

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
};

/// Whether stderr is a terminal.
bool stderr_is_terminal();

} // namespace celltrace::cli
