// The statistics of one SPE: written by its thread, read by the PPE at any time.
#pragma once

#include "celltrace/spe/machine.hpp"

#include <atomic>

namespace celltrace::cell_emu {

/// A count with one writer.
class Counter {
public:
  void add(std::uint64_t n) {
    value_.store(value_.load(std::memory_order_relaxed) + n, std::memory_order_relaxed);
  }
  void raise_to(std::uint64_t n) {
    if (n > value()) value_.store(n, std::memory_order_relaxed);
  }
  std::uint64_t value() const { return value_.load(std::memory_order_relaxed); }

private:
  std::atomic<std::uint64_t> value_{0};
};

struct Counters {
  Counter dma_commands, dma_list_elements, dma_bytes_read, dma_bytes_written;
  Counter signals_sent, mailbox_words_sent, local_store_peak;

  SpeStatistics statistics() const {
    return {dma_commands.value(),      dma_list_elements.value(), dma_bytes_read.value(),
            dma_bytes_written.value(), signals_sent.value(),      mailbox_words_sent.value(),
            local_store_peak.value()};
  }
};

} // namespace celltrace::cell_emu
