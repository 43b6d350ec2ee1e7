// A mailbox: a short queue of 32-bit words. Not synchronised; see problem_state.hpp.
#pragma once

#include "backends/cell_emu/cycle.hpp"

#include <array>
#include <cstdint>

namespace celltrace::cell_emu {

/// A word on its way: its value, and the arrow that a trace draws for it (0: none).
struct Word {
  std::uint32_t value = 0;
  std::uint64_t arrow = 0;
  Cycle at = 0; ///< when it arrived
};

template <unsigned Entries> class Mailbox {
public:
  unsigned count() const { return count_; }
  bool empty() const { return count_ == 0; }
  bool full() const { return count_ == Entries; }

  /// Appends a word; a full mailbox loses its newest word to it.
  void push(Word word) {
    if (!full()) ++count_;
    entries_[(first_ + count_ - 1) % Entries] = word;
  }
  /// The oldest word. Not for an empty mailbox.
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
