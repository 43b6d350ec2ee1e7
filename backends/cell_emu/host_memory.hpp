// What of the host's address space can be read and written: main memory, as far as the host tells.
//
// On Linux that is /proc/self/maps, read by each program for itself when it meets an address that is not known
// to be accessible. What is known is kept while the program runs, as to ask for every command would take
// longer than the command: memory that the process gives back meanwhile still counts as accessible, and a
// command that touches it ends as an access by the host would. On other hosts everything counts as
// accessible.
#pragma once

#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <optional>

namespace celltrace::cell_emu {

/// Addresses [begin, end).
struct MemoryRange {
  ea_t begin = 0, end = 0;

  bool has(ea_t ea, std::uint32_t size) const { return ea >= begin && ea <= end && size <= end - ea; }
};

/// The largest known range around [ea, ea + size) that the process can read, or write. Nothing: not all of it
/// is accessible. Thread-safe.
std::optional<MemoryRange> accessible_memory(ea_t ea, std::uint32_t size, bool write);

/// Forgets what is known. Thread-safe.
void forget_memory();

/// Remembers the ranges of the last answers. Thread safety: none.
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
  MemoryRange last_[2]; ///< of reads, of writes
};

} // namespace celltrace::cell_emu
