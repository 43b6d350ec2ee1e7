// The decrementer of one SPE, driven by the host's steady clock.
#pragma once

#include <chrono>
#include <cstdint>

namespace celltrace::native {

/// Counts down at the timebase of a PlayStation 3, 79.8 MHz, and wraps at zero. Stopped until the first
/// write. Thread safety: none; it belongs to the SPE's thread.
class Decrementer {
public:
  using Clock = std::chrono::steady_clock;

  /// Loads a value and starts to count.
  void write(std::uint32_t value);
  std::uint32_t read() const;
  /// Stops the decrementer until the next write.
  void stop();

  bool counts() const noexcept { return counts_; }
  /// Returns true if the value fell below zero since the last call (the decrementer event).
  bool take_expiry();
  /// Returns the time of the first fall below zero that take_expiry() has not yet returned.
  Clock::time_point next_expiry() const;

private:
  std::uint64_t elapsed_ticks() const;

  Clock::time_point start_{};
  std::uint32_t value_ = 0;
  std::uint64_t expiries_taken_ = 0;
  bool counts_ = false;
};

} // namespace celltrace::native
