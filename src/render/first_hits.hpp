// What is seen first: from the records that the SPEs have put behind the points of a grid.
#pragma once

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"
#include "memory/aligned_block.hpp"
#include "records/frame.hpp"
#include "scene_image/scene_image.hpp"

#include <bit>

namespace celltrace {

/// The pixels that are asked for, and which point of the grid that is in memory the first of them is.
struct GridAtPicture {
  PictureRegion region;
  std::uint32_t first_column, first_row;
};

/// Where pixels of `picture` have no alpha because they have not been rendered, nothing is seen.
FirstHits read_first_hits(const AlignedBlock& grid_points, const kernel::FrameBlock& frame,
                          const Image& picture, const GridAtPicture& grid, std::endian order,
                          const SceneImage& image);

} // namespace celltrace
