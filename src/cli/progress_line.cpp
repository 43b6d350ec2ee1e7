#include "cli/progress_line.hpp"

#include <cstdio>
#include <ostream>
#include <utility>

#include <unistd.h>

namespace celltrace::cli {

namespace {

std::string minutes(double seconds) {
  const long whole = static_cast<long>(seconds);
  char text[40];
  std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  return text;
}

} // namespace

std::string progress_text(double fraction, std::chrono::duration<double> elapsed) {
  const double gone = elapsed.count();
  char percent[16];
  std::snprintf(percent, sizeof percent, "%3.0f %%  ", 100 * fraction);
  std::string text = percent + minutes(gone);
  if (gone >= 1 && fraction >= 0.01) text += ", " + minutes(gone * (1 - fraction) / fraction) + " to go";
  return text;
}

ProgressLine::ProgressLine(std::ostream& out, bool visible, std::string job, std::chrono::milliseconds delay)
    : out_(out), visible_(visible), job_(std::move(job)), next_(start_ + delay) {
}

ProgressLine::~ProgressLine() {
  wipe();
}

void ProgressLine::wipe() {
  if (drawn_) out_ << "\r\x1b[K" << std::flush;
  drawn_ = false;
}

void ProgressLine::update(double fraction) {
  if (!visible_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  drawn_ = true;
  out_ << "\r\x1b[K" << job_ << progress_text(fraction, now - start_) << std::flush;
}

bool stderr_is_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

} // namespace celltrace::cli
