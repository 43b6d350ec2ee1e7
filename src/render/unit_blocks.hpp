// Which pixels a unit of work has.
#pragma once

#include "celltrace/render.hpp"
#include "records/frame.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// The blocks that units are made of, as they lie in the picture.
struct BlockGrid {
  std::uint32_t columns; ///< of blocks
  int edge;              ///< pixels
  int left, top;         ///< of the first block, in the picture
  PictureRegion region;  ///< of the picture that is rendered
};

/// The parts of the region that a unit's blocks cover, row of blocks by row.
std::vector<PictureRegion> regions_of(const kernel::UnitRecord& unit, const BlockGrid& grid);

} // namespace celltrace
