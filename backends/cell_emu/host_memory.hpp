// Finds out which addresses of the host can be read and written. These addresses are the main memory of the
// emulated Cell.
//
// On Linux, /proc/self/maps is read when a program uses an address that is not yet known to be accessible.
// The answers are kept while the program runs, because asking for every command would take longer than the
// command. Memory that the process gives back meanwhile still counts as accessible; a command on it crashes,
// as an access by the host would. On other hosts all memory counts as accessible.
#pragma once

#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <optional>

namespace celltrace::cell_emu {

/// A range of addresses, [begin, end).
struct MemoryRange {
  ea_t begin = 0, end = 0;

  bool has(ea_t ea, std::uint32_t size) const { return ea >= begin && ea <= end && size <= end - ea; }
};

/// Returns the largest known range around [ea, ea + size) that the process can read, or with `write` can
/// write; nothing if a part of [ea, ea + size) is not accessible. Thread-safe.
std::optional<MemoryRange> accessible_memory(ea_t ea, std::uint32_t size, bool write);

/// Forgets all known ranges. Thread-safe.
void forget_memory();

/// A cache of the last ranges that accessible_memory() returned. Thread safety: none.
class HostMemory {
public:
  bool is_accessible(ea_t ea, std::uint32_t size, bool write) {
    if (last_[write].has(ea, size)) [[likely]]
      return true;
    const std::optional<MemoryRange> range = accessible_memory(ea, size, write);
    if (range) last_[write] = *range;
    return range.has_value();
  }

  void forget() {
    last_[0] = last_[1] = {};
    forget_memory();
  }

private:
  MemoryRange last_[2]; ///< for reads, for writes
};

} // namespace celltrace::cell_emu
