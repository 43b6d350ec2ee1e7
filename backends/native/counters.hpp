// The statistics counters of one SPE.
#pragma once

#include "celltrace/spe/machine.hpp"

#include <atomic>
#include <cstdint>

namespace celltrace::native {

/// A counter that one thread raises and other threads may read at any time; as fast as a plain integer.
class Counter {
public:
  void add(std::uint64_t amount) noexcept { set(get() + amount); }
  void raise_to(std::uint64_t value) noexcept {
    if (value > get()) set(value);
  }
  std::uint64_t get() const noexcept { return value_.load(std::memory_order_relaxed); }

private:
  void set(std::uint64_t value) noexcept { value_.store(value, std::memory_order_relaxed); }

  std::atomic<std::uint64_t> value_{0};
};

/// The counters of an SPE. Written by the SPE's thread only.
struct Counters {
  Counter dma_commands;
  Counter dma_list_elements;
  Counter dma_bytes_read;
  Counter dma_bytes_written;
  Counter signals_sent;
  Counter mailbox_words_sent;
  Counter local_store_peak;

  SpeStatistics snapshot() const {
    return {dma_commands.get(),
            dma_list_elements.get(),
            dma_bytes_read.get(),
            dma_bytes_written.get(),
            signals_sent.get(),
            mailbox_words_sent.get(),
            local_store_peak.get(),
            0,
            0,
            0,
            {}};
  }
};

} // namespace celltrace::native
