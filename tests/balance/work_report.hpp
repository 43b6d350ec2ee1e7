// What the programs that exchange work have in common. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::test {

/// What an SPE did in a frame; FrameBlock::reports has one for each.
struct alignas(16) WorkReport {
  uint32_t units; ///< completed
  uint32_t exchanges;
  uint32_t units_received;
  uint32_t steps; ///< of the units completed
};
static_assert(sizeof(WorkReport) == 16, "crosses DMA");

/// Reads what came too late for a frame.
template <class Spu> void drain(Spu& spu) {
  while (spu.in_mailbox_count() != 0)
    spu.read_in_mailbox();
  if (spu.signal_2_count() != 0) spu.read_signal_2();
}

} // namespace celltrace::test
