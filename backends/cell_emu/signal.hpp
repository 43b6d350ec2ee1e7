// A signal notification register. Not synchronised; see problem_state.hpp.
#pragma once

#include "backends/cell_emu/mailbox.hpp"
#include "celltrace/spe/types.hpp"

#include <cstdint>

namespace celltrace::cell_emu {

class SignalRegister {
public:
  explicit SignalRegister(SignalMode mode) : mode_(mode) {}

  /// Returns the channel count: 1 while a write has not been read.
  unsigned count() const { return count_; }
  /// Returns true if a write now would replace an unread value.
  bool loses_a_value() const { return count_ != 0 && mode_ == SignalMode::overwrite; }
  void write(Word word) {
    word_.value = mode_ == SignalMode::logical_or ? word_.value | word.value : word.value;
    word_.arrow = word.arrow;
    word_.at = word.at;
    count_ = 1;
  }
  /// Returns the word for the SPU; clears value and count.
  Word read() {
    const Word word = word_;
    word_ = {};
    count_ = 0;
    return word;
  }
  /// Returns the value for a read by its effective address, which changes nothing.
  std::uint32_t peek() const { return word_.value; }

private:
  SignalMode mode_;
  Word word_;
  unsigned count_ = 0;
};

} // namespace celltrace::cell_emu
