#include "backends/cell_emu/host_memory.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <shared_mutex>
#include <string>
#include <vector>

namespace celltrace::cell_emu {
namespace {

/// Ranges in ascending order that do not touch each other.
class Ranges {
public:
  void add(MemoryRange range) {
    if (!ranges_.empty() && ranges_.back().end == range.begin)
      ranges_.back().end = range.end;
    else
      ranges_.push_back(range);
  }
  std::optional<MemoryRange> around(ea_t ea, std::uint32_t size) const {
    const auto behind = std::upper_bound(ranges_.begin(), ranges_.end(), ea,
                                         [](ea_t at, const MemoryRange& range) { return at < range.begin; });
    if (behind == ranges_.begin() || !std::prev(behind)->has(ea, size)) return std::nullopt;
    return *std::prev(behind);
  }

private:
  std::vector<MemoryRange> ranges_;
};

struct Maps {
  Ranges accessible[2]; ///< for reads, for writes
  bool known = false;   ///< true if the host lists its memory
};

Maps read_maps() {
  Maps maps;
#ifdef __linux__
  std::ifstream file("/proc/self/maps");
  for (std::string line; std::getline(file, line);) {
    MemoryRange range;
    char permissions[5] = "";
    if (std::sscanf(line.c_str(), "%" SCNx64 "-%" SCNx64 " %4s", &range.begin, &range.end, permissions) != 3)
      continue;
    maps.known = true;
    if (permissions[0] == 'r') maps.accessible[false].add(range);
    if (permissions[0] == 'r' && permissions[1] == 'w') maps.accessible[true].add(range);
  }
#endif
  return maps;
}

/// The ranges of the last read of /proc/self/maps, for all threads.
struct Shared {
  std::shared_mutex mutex;
  Maps maps;
};
Shared& shared() {
  static Shared all;
  return all;
}

} // namespace

void forget_memory() {
  Shared& all = shared();
  const std::lock_guard lock(all.mutex);
  all.maps = {};
}

std::optional<MemoryRange> accessible_memory(ea_t ea, std::uint32_t size, bool write) {
  Shared& all = shared();
  {
    const std::shared_lock lock(all.mutex);
    if (const auto range = all.maps.accessible[write].around(ea, size)) return range;
  }
  const std::lock_guard lock(all.mutex);
  all.maps = read_maps();
  if (!all.maps.known) return MemoryRange{0, ~ea_t{0}};
  return all.maps.accessible[write].around(ea, size);
}

} // namespace celltrace::cell_emu
