// A mailbox: a short queue of 32-bit words. Not synchronised; see problem_state.hpp.
#pragma once

#include "backends/cell_emu/cycle.hpp"

#include <array>
#include <cstdint>

namespace celltrace::cell_emu {

/// A word that is sent: its value, the number of its arrow in the trace (0: none), and the virtual time of
/// arrival.
struct Word {
  std::uint32_t value = 0;
  std::uint64_t arrow = 0;
  Cycle at = 0; ///< time of its arrival
};

template <unsigned Entries> class Mailbox {
public:
  unsigned count() const { return count_; }
  bool empty() const { return count_ == 0; }
  bool full() const { return count_ == Entries; }

  /// Appends a word; in a full mailbox it replaces the newest word.
  void push(Word word) {
    if (!full()) ++count_;
    entries_[(first_ + count_ - 1) % Entries] = word;
  }
  /// Removes and returns the oldest word. The mailbox must not be empty.
  Word pop() {
    const Word word = entries_[first_];
    first_ = (first_ + 1) % Entries;
    --count_;
    return word;
  }

private:
  std::array<Word, Entries> entries_{};
  unsigned first_ = 0;
  unsigned count_ = 0;
};

} // namespace celltrace::cell_emu
