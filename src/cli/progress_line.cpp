#include "cli/progress_line.hpp"

#include <algorithm>
#include <cmath>
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

void RemainingTime::learn(double fraction, double seconds) {
  if (!first_) first_ = fraction_ = fraction;
  if (fraction <= fraction_) return;
  fraction_ = fraction;
  constexpr double kLeastSeconds = 1, kLeastDone = 0.01, kPart = 0.1;
  if (seconds < kLeastSeconds || fraction - *first_ < kLeastDone) return;
  const double end = seconds * (1 - *first_) / (fraction - *first_);
  end_ = end_ ? *end_ + kPart * (end - *end_) : end;
}

std::optional<double> RemainingTime::at(double seconds) const {
  if (!end_) return std::nullopt;
  if (fraction_ >= 1) return 0;
  // The job is not over yet, whatever the estimate was.
  const double even = seconds * (1 - fraction_) / (fraction_ - *first_);
  return std::max(*end_ - seconds, even / 2);
}

std::string progress_text(double fraction, double seconds, std::optional<double> to_go) {
  char percent[16];
  std::snprintf(percent, sizeof percent, "%3.0f %%  ", 100 * fraction);
  std::string text = percent + minutes(seconds);
  if (to_go) text += ", " + minutes(std::ceil(*to_go)) + " to go";
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
  const double seconds = std::chrono::duration<double>(now - start_).count();
  remaining_.learn(fraction, seconds);
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  drawn_ = true;
  out_ << "\r\x1b[K" << job_ << progress_text(fraction, seconds, remaining_.at(seconds)) << std::flush;
}

bool stderr_is_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

} // namespace celltrace::cli
