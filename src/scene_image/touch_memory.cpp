#include "scene_image/touch_memory.hpp"

#include "scene/build_watch.hpp"
#include "scene/parallel.hpp"

#include <cstdint>

namespace celltrace {

void touch(AlignedBlock& block, std::size_t bytes, unsigned threads) {
  constexpr std::size_t kPage = 4096, kBetweenLooks = std::size_t{2} << 20;
  const auto parts = static_cast<std::uint32_t>(bytes / kBetweenLooks);
  for_each_part(threads, [&](unsigned part) {
    const HostPart mine(parts, part, threads);
    for (std::size_t at = mine.begin * kBetweenLooks; at < mine.end * kBetweenLooks; at += kPage) {
      if (at % kBetweenLooks == 0) BuildWatch::look();
      *const_cast<volatile std::byte*>(block.data() + at) = std::byte(0);
    }
  });
}

} // namespace celltrace
