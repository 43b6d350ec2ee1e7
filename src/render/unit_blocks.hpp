// Finds the pixels of a unit of work.
#pragma once

#include "celltrace/render.hpp"
#include "records/frame.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// The blocks that units consist of, and their place in the picture.
struct BlockGrid {
  std::uint32_t columns; ///< blocks per row
  int edge;              ///< edge of a block in pixels
  int left, top;         ///< position of the first block in the picture
  PictureRegion region;  ///< part of the picture that is rendered
};

/// Returns the parts of the region that a unit's blocks cover, one per row of blocks.
std::vector<PictureRegion> regions_of(const kernel::UnitRecord& unit, const BlockGrid& grid);

} // namespace celltrace
