#include "render/unit_blocks.hpp"

#include <algorithm>

namespace celltrace {

std::vector<PictureRegion> regions_of(const kernel::UnitRecord& unit, const BlockGrid& grid) {
  std::vector<PictureRegion> regions;
  std::uint32_t column = unit.column, row = unit.row;
  for (std::uint32_t left = unit.bundles; left != 0; column = 0, ++row) {
    const std::uint32_t blocks = std::min(left, grid.columns - column);
    left -= blocks;
    PictureRegion region;
    region.left = std::max(grid.left + static_cast<int>(column) * grid.edge, grid.region.left);
    region.right = std::min(grid.left + static_cast<int>(column + blocks) * grid.edge, grid.region.right);
    region.top = std::max(grid.top + static_cast<int>(row) * grid.edge, grid.region.top);
    region.bottom = std::min(grid.top + static_cast<int>(row + 1) * grid.edge, grid.region.bottom);
    if (region.left < region.right && region.top < region.bottom) regions.push_back(region);
  }
  return regions;
}

} // namespace celltrace
