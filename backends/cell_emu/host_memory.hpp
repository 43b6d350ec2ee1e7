// Finds out which part of the host's address space can be read and written: main memory, as far as the host
// tells.
//
// On Linux this is /proc/self/maps, which each program reads when it meets an address that is not known
// to be accessible. The answers are kept while the program runs, since asking for every command would take
// longer than the command: memory that the process gives back meanwhile still counts as accessible, and a
// command that touches it crashes as an access by the host would. On other hosts everything counts as
// accessible.
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

/// Returns the largest known range around [ea, ea + size) that the process can read, or write; nothing if a
/// part is not accessible. Thread-safe.
std::optional<MemoryRange> accessible_memory(ea_t ea, std::uint32_t size, bool write);

/// Forgets all known ranges. Thread-safe.
void forget_memory();

/// A cache of the ranges of the last answers. Thread safety: none.
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
