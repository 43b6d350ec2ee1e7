// Doorbells by which the SPEs of a pipeline tell each other of work: bits of signal 2, which merge and cannot
// be lost, or bits of words in the mailbox. Kernel dialect.
#pragma once

#include "celltrace/spe/spu.hpp"
#include "kernel/models/stage_block.hpp"

namespace celltrace::kernel::models {

/// Bits that were rung and have not been taken.
template <class Spu> class Doorbell {
public:
  Doorbell(Spu& spu, const StageBlock& stage)
      : spu_(spu), by_mailbox_((stage.tasks & task::by_mailbox) != 0) {}

  /// Sleeps until a bit is rung.
  void wait() {
    rung_ |= by_mailbox_ ? spu_.read_in_mailbox() : spu_.read_signal_2();
    poll();
  }
  /// Collects bits that were rung meanwhile.
  void poll() {
    if (by_mailbox_) {
      while (spu_.in_mailbox_count() != 0)
        rung_ |= spu_.read_in_mailbox();
    } else if (spu_.signal_2_count() != 0) {
      rung_ |= spu_.read_signal_2();
    }
  }

  bool take(uint32_t bit) {
    const bool rung = (rung_ & bit) != 0;
    rung_ &= ~bit;
    return rung;
  }
  /// Takes a context that was rung, in round-robin order. Returns false if there is none.
  bool take_context(uint32_t& context) {
    const uint32_t contexts = rung_ & bell::contexts;
    if (contexts == 0) return false;
    const uint32_t behind = contexts & ~((2u << last_) - 1);
    last_ = static_cast<uint32_t>(__builtin_ctz(behind != 0 ? behind : contexts));
    rung_ &= ~(1u << last_);
    context = last_;
    return true;
  }

private:
  Spu& spu_;
  bool by_mailbox_;
  uint32_t rung_ = 0;
  uint32_t last_ = 0;
};

/// A word for a register of another SPE: in the last word of a quadword, as the registers are.
struct alignas(16) OutgoingWord {
  uint32_t unused[3];
  uint32_t value;
};

/// Rings an SPE after all commands of `tag`, without waiting for them: the receiver may rely on the data that
/// these commands put. `word` must not change until the tag group is complete.
template <class Spu>
void ring_behind(Spu& spu, uint32_t spe, uint32_t bits, OutgoingWord& word, uint32_t tag) {
  word.value = bits;
  spu.template mfc_command<MfcOpcode::sndsigf>(&word.value, spu.addresses(spe).signal_2, 4, tag);
}

} // namespace celltrace::kernel::models
