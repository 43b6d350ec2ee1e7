// When the data of a queued command really moves.
#pragma once

#include <cstdint>

namespace celltrace::cell_emu {

/// Late: a command moves when a wait needs it, when the queue is full, when the SPU stalls, or one at a time
/// while the SPU polls. So a program that uses data before it has waited for them does not get them by luck.
/// A command that many waits have passed over moves nevertheless, because a program may wait for its effect
/// elsewhere.
class LateTransfers {
public:
  /// A tag wait has been satisfied.
  void count_wait() { ++waits_; }
  /// The mark of a command that is queued now.
  std::uint32_t mark() const { return waits_; }
  bool overdue(std::uint32_t mark) const { return waits_ - mark >= kPatience; }

private:
  static constexpr std::uint32_t kPatience = 16;
  std::uint32_t waits_ = 0;
};

} // namespace celltrace::cell_emu
