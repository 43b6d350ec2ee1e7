#include "side.hpp"

namespace celltrace::compare {

std::uint64_t covered_pixels(const Image& picture) {
  // Grey surfaces have a blue channel far below the background's.
  std::uint64_t covered = 0;
  for (std::size_t blue = 2; blue < picture.rgba.size(); blue += 4)
    covered += picture.rgba[blue] < 255;
  return covered;
}

} // namespace celltrace::compare
