// A signal notification register. Not synchronised; see problem_state.hpp.
#pragma once

#include "celltrace/spe/types.hpp"

#include <cstdint>

namespace celltrace::cell_emu {

class SignalRegister {
public:
  explicit SignalRegister(SignalMode mode) : mode_(mode) {}

  /// The channel count: 1 while a write has not been read.
  unsigned count() const { return count_; }
  /// True if the count rose by this write.
  bool write(std::uint32_t value) {
    value_ = mode_ == SignalMode::logical_or ? value_ | value : value;
    const bool rose = count_ == 0;
    count_ = 1;
    return rose;
  }
  /// The SPU's read: clears value and count.
  std::uint32_t read() {
    const std::uint32_t value = value_;
    value_ = 0;
    count_ = 0;
    return value;
  }
  /// A read through the main storage domain changes nothing.
  std::uint32_t peek() const { return value_; }

private:
  SignalMode mode_;
  std::uint32_t value_ = 0;
  unsigned count_ = 0;
};

} // namespace celltrace::cell_emu
