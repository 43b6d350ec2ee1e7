// A mailbox: a short queue of 32-bit words. Not synchronised; see problem_state.hpp.
#pragma once

#include <array>
#include <cstdint>

namespace celltrace::cell_emu {

template <unsigned Entries> class Mailbox {
public:
  unsigned count() const { return count_; }
  bool empty() const { return count_ == 0; }
  bool full() const { return count_ == Entries; }

  /// Appends a word; a full mailbox loses its newest word to it.
  void push(std::uint32_t value) {
    if (!full()) ++count_;
    entries_[(first_ + count_ - 1) % Entries] = value;
  }
  /// The oldest word. Not for an empty mailbox.
  std::uint32_t pop() {
    const std::uint32_t value = entries_[first_];
    first_ = (first_ + 1) % Entries;
    --count_;
    return value;
  }

private:
  std::array<std::uint32_t, Entries> entries_{};
  unsigned first_ = 0;
  unsigned count_ = 0;
};

} // namespace celltrace::cell_emu
