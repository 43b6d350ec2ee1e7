// The timing model of DMA: the SPEs' ports, the memory controller and the bus each transfer one line at a
// time, in the order of requests.
#pragma once

#include "celltrace/spe/timing.hpp"
#include "celltrace/spe/types.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace celltrace::cell_emu {

/// The other side of a transfer.
enum class DmaTarget : unsigned char { memory, local_store, problem_state };

/// The timing of all transfers. Thread safety: none.
class DmaTiming {
public:
  DmaTiming(const TimingParameters& timing, unsigned spes) : timing_(timing), port_free_(spes, 0) {}

  /// Returns the cycle in which a transfer that starts at `start` is complete. `other` is the SPE on the
  /// other side, unless the other side is memory. A partial line takes as long as a whole line.
  std::uint64_t complete(unsigned spe, std::uint64_t start, DmaTarget target, unsigned other, ea_t ea,
                         std::uint32_t bytes) {
    const std::uint64_t lines = ((ea % kLineBytes) + bytes + kLineBytes - 1) / kLineBytes;
    const bool memory = target == DmaTarget::memory;
    std::uint64_t through = occupy(port_free_[spe], start, lines * timing_.port_line);
    if (!memory && other != spe)
      through = std::max(through, occupy(port_free_[other], start, lines * timing_.port_line));
    if (memory) through = std::max(through, occupy(memory_free_, start, lines * timing_.memory_line));
    through = std::max(through, occupy(bus_free_, start, lines * timing_.bus_line));
    // The latency includes the first line's time in the port.
    const std::uint64_t latency = memory ? timing_.first_line_memory : timing_.first_line_spe;
    return through + latency - std::min<std::uint64_t>(latency, timing_.port_line);
  }

private:
  static std::uint64_t occupy(std::uint64_t& free, std::uint64_t start, std::uint64_t busy) {
    free = std::max(free, start) + busy;
    return free;
  }

  TimingParameters timing_;
  std::vector<std::uint64_t> port_free_;
  std::uint64_t memory_free_ = 0;
  std::uint64_t bus_free_ = 0;
};

} // namespace celltrace::cell_emu
