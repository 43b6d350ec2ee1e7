// The SPU event facility: channels 0, 1, 2 and 11. Not synchronised; see problem_state.hpp.
//
// Events become pending even if the mask disables them. The count of channel 0 is 0 or 1. It becomes 1 when
// an enabled event occurs (even if this event is already pending), or when an enabled event is still pending
// after a write of the mask or an acknowledge. Only a read of the status makes the count 0. If the event was
// masked or acknowledged before the read, the status is 0: a phantom event.
#pragma once

#include "celltrace/spe/types.hpp"

#include <cstdint>

namespace celltrace::cell_emu {

class EventFacility {
public:
  std::uint32_t pending() const { return pending_; }
  std::uint32_t mask() const { return mask_; }
  unsigned count() const { return count_; }

  void raise(std::uint32_t bits) {
    pending_ |= bits;
    if ((bits & mask_) != 0) count_ = 1;
  }
  void write_mask(std::uint32_t mask) {
    mask_ = mask;
    count_enabled();
  }
  void acknowledge(std::uint32_t bits) {
    pending_ &= ~bits;
    count_enabled();
  }
  /// Returns the value of channel 0, the pending enabled events. Clears the count, but no pending bit.
  std::uint32_t read_status() {
    count_ = 0;
    return pending_ & mask_;
  }
  /// Resets the facility; the events `pending` are pending afterwards.
  void reset(std::uint32_t pending) {
    pending_ = pending;
    mask_ = 0;
    count_ = 0;
  }

private:
  void count_enabled() {
    if ((pending_ & mask_) != 0) count_ = 1;
  }

  std::uint32_t pending_ = 0;
  std::uint32_t mask_ = 0;
  unsigned count_ = 0;
};

} // namespace celltrace::cell_emu
