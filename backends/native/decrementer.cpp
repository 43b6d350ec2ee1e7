#include "backends/native/decrementer.hpp"

namespace celltrace::native {

namespace {

// The timebase of 79.8 MHz as a fraction: 399 ticks in 5000 nanoseconds.
constexpr std::uint64_t kTicks = 399;
constexpr std::uint64_t kNanoseconds = 5000;

} // namespace

void Decrementer::write(std::uint32_t value) {
  start_ = Clock::now();
  value_ = value;
  expiries_taken_ = 0;
  counts_ = true;
}

std::uint32_t Decrementer::read() const {
  return counts_ ? value_ - static_cast<std::uint32_t>(elapsed_ticks()) : value_;
}

void Decrementer::stop() {
  value_ = read();
  counts_ = false;
}

bool Decrementer::take_expiry() {
  if (!counts_) return false;
  const std::uint64_t ticks = elapsed_ticks();
  const std::uint64_t expiries = ticks > value_ ? 1 + ((ticks - value_ - 1) >> 32) : 0;
  const bool expired = expiries > expiries_taken_;
  expiries_taken_ = expiries;
  return expired;
}

Decrementer::Clock::time_point Decrementer::next_expiry() const {
  const std::uint64_t ticks = value_ + 1 + (expiries_taken_ << 32);
  const std::uint64_t nanoseconds =
      ticks / kTicks * kNanoseconds + (ticks % kTicks * kNanoseconds) / kTicks + 1;
  return start_ + std::chrono::nanoseconds(nanoseconds);
}

std::uint64_t Decrementer::elapsed_ticks() const {
  const auto elapsed = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start_);
  return static_cast<std::uint64_t>(elapsed.count()) * kTicks / kNanoseconds;
}

} // namespace celltrace::native
