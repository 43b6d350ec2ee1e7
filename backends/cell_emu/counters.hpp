// The statistics of one SPE: written by its thread, read by the PPE at any time.
#pragma once

#include "celltrace/spe/machine.hpp"

#include <atomic>
#include <iterator>

namespace celltrace::cell_emu {

/// A counter with one writer.
class Counter {
public:
  void add(std::uint64_t n) {
    value_.store(value_.load(std::memory_order_relaxed) + n, std::memory_order_relaxed);
  }
  void set(std::uint64_t n) { value_.store(n, std::memory_order_relaxed); }
  void raise_to(std::uint64_t n) {
    if (n > value()) value_.store(n, std::memory_order_relaxed);
  }
  std::uint64_t value() const { return value_.load(std::memory_order_relaxed); }

private:
  std::atomic<std::uint64_t> value_{0};
};

/// The members of SpuCycles, as counters.
class CycleCounters {
public:
  void publish(const SpuCycles& cycles) {
    for (std::size_t i = 0; i < std::size(kSpuCycleCounts); ++i)
      counters_[i].set(cycles.*kSpuCycleCounts[i].second);
  }
  SpuCycles value() const {
    SpuCycles cycles;
    for (std::size_t i = 0; i < std::size(kSpuCycleCounts); ++i)
      cycles.*kSpuCycleCounts[i].second = counters_[i].value();
    return cycles;
  }

private:
  Counter counters_[std::size(kSpuCycleCounts)];
};

struct Counters {
  Counter dma_commands, dma_list_elements, dma_bytes_read, dma_bytes_written;
  Counter signals_sent, mailbox_words_sent, local_store_peak;
  Counter module_fetches, module_bytes, module_cycles;
  CycleCounters cycles;

  SpeStatistics statistics() const {
    return {dma_commands.value(),
            dma_list_elements.value(),
            dma_bytes_read.value(),
            dma_bytes_written.value(),
            signals_sent.value(),
            mailbox_words_sent.value(),
            local_store_peak.value(),
            module_fetches.value(),
            module_bytes.value(),
            module_cycles.value(),
            cycles.value()};
  }
};

} // namespace celltrace::cell_emu
