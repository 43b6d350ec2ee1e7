// The decrementer of an emulated SPE, which counts down with the SPE's virtual cycles.
#pragma once

#include <cstdint>

namespace celltrace::cell_emu {

class Decrementer {
public:
  /// Makes a decrementer that counts down by 1 every `cycles_per_tick` cycles.
  explicit Decrementer(std::uint32_t cycles_per_tick) : cycles_per_tick_(cycles_per_tick) {}

  /// Starts the decrementer from `value` at virtual time `cycles`; call advance(cycles) before. Returns true
  /// if the top bit goes from 0 to 1, which raises the decrementer event, as it does in counting.
  bool write(std::uint32_t value, std::uint64_t cycles) {
    const bool rises = (~value_ & value) >> 31 != 0;
    value_ = value;
    since_ = cycles;
    running_ = true;
    return rises;
  }
  /// Stops the decrementer at virtual time `cycles` until the next write.
  void freeze(std::uint64_t cycles) {
    advance(cycles);
    running_ = false;
  }
  bool running() const { return running_; }
  std::uint32_t value() const { return value_; }

  /// Counts down until virtual time `cycles`. Returns true if the top bit went from 0 to 1, which is the
  /// decrementer event.
  bool advance(std::uint64_t cycles) {
    if (!running_) return false;
    const std::uint64_t ticks = (cycles - since_) / cycles_per_tick_;
    const bool expired = ticks > value_;
    value_ -= static_cast<std::uint32_t>(ticks);
    since_ += ticks * cycles_per_tick_;
    return expired;
  }
  /// Returns the virtual time of the next event if the decrementer keeps running.
  std::uint64_t expiry() const { return since_ + (std::uint64_t{value_} + 1) * cycles_per_tick_; }

private:
  std::uint64_t cycles_per_tick_;
  std::uint32_t value_ = 0;
  std::uint64_t since_ = 0;
  bool running_ = false;
};

} // namespace celltrace::cell_emu
