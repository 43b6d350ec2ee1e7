// Reads the first hits from the records that the SPEs have written behind the points of a grid.
#pragma once

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"
#include "memory/aligned_block.hpp"
#include "records/frame.hpp"
#include "scene_image/scene_image.hpp"

#include <bit>

namespace celltrace {

/// The pixels of a result, and the place of the first pixel on the grid in memory.
struct GridAtPicture {
  PictureRegion region;
  std::uint32_t first_column, first_row;
};

/// Returns the first hits. Pixels of `picture` without alpha have not been rendered, so that they have no
/// hit.
FirstHits read_first_hits(const AlignedBlock& grid_points, const kernel::FrameBlock& frame,
                          const Image& picture, const GridAtPicture& grid, std::endian order,
                          const SceneImage& image);

} // namespace celltrace
