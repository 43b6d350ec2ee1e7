#include "scene_image/touch_memory.hpp"

#include "scene/parallel.hpp"
#include "scene/progress_monitor.hpp"

#include <cstdint>

namespace celltrace {

void touch(AlignedBlock& block, std::size_t bytes, unsigned threads) {
  constexpr std::size_t kPage = 4096, kPartBytes = std::size_t{2} << 20;
  const auto parts = static_cast<std::uint32_t>(bytes / kPartBytes);
  for_each_part(threads, [&](unsigned part) {
    const HostPart mine(parts, part, threads);
    for (std::size_t at = mine.begin * kPartBytes; at < mine.end * kPartBytes; at += kPage) {
      if (at % kPartBytes == 0) ProgressMonitor::check_cancelled();
      *const_cast<volatile std::byte*>(block.data() + at) = std::byte(0);
    }
  });
}

} // namespace celltrace
