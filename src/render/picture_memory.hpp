// The picture in main memory, as the SPEs write it, and its conversion to results on the host.
#pragma once

#include "celltrace/render.hpp"
#include "memory/aligned_block.hpp"
#include "records/frame.hpp"
#include "render/first_hits.hpp"
#include "render/unit_blocks.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace celltrace {

class SceneImage;

/// Rows [top, bottom) of the region that is rendered.
struct RowRange {
  int top, bottom;
  bool operator==(const RowRange&) const = default;
};

/// The memory for pixels, colours, the points of a grid and the SPEs' samples, as far as a picture needs
/// them.
class PictureMemory {
public:
  /// Refers to the options, which are read at each call, and to the host's frame block.
  PictureMemory(const RenderOptions& options, kernel::FrameBlock& frame, std::endian order)
      : options_(options), frame_(frame), order_(order) {}

  /// Allocates the memory that the options need, and sets its place in the frame block. Pixels in memory are
  /// lost.
  void make_room(unsigned spes, std::uint32_t bundle_edge);
  /// Makes the memory begin with these rows, if it has room for a part of the picture only. Keeps points of
  /// the grid from these rows to line `kept` (excluded), if any are in memory.
  void begin_at(const RowRange& rows, std::uint32_t kept);
  /// Returns all rows of the picture.
  RowRange rows() const;
  /// Clears points from this line of the grid on to transparent black, and all colours. A line before the
  /// memory's first line counts as the first line.
  void clear_from(std::uint32_t line);
  /// Returns the place of this frame's blocks in the picture.
  BlockGrid blocks(std::uint32_t bundle_edge) const;
  /// Calls RenderOptions::finished_block for each region.
  void report_blocks(const std::vector<PictureRegion>& regions, unsigned spe) const;
  /// Turns the colours of the grid's points into the colours of pixels, in the SPEs' byte order, if the
  /// options ask for colours.
  void keep_colours(const RowRange& rows);
  /// Copies the picture to the result, in each form that the options ask for.
  void copy(const RowRange& rows, const SceneImage& image, RenderResult& result);

private:
  void make_room_for_samples(unsigned spes, std::uint32_t bundle_edge);
  bool has_whole_picture() const;
  /// Returns the first line of the grid that is in memory.
  std::uint32_t first_line() const;
  std::byte* line_of_surface(std::uint32_t line) const;
  std::byte* line_of_colours(std::uint32_t line) const;
  std::byte* row_of_points(std::uint32_t packet_row) const;
  /// Returns the place of rows of the region in the result, which is a picture of the whole region or of
  /// these rows alone.
  PictureRegion place_in_result(const RowRange& rows) const;
  /// Returns a picture for the result, opaque black.
  template <class Picture> Picture make_picture(const RowRange& rows) const;
  /// Returns whether the grid begins to the upper left of the picture, as the grid of the fixed method does.
  bool begins_before_picture() const;
  const std::uint8_t* first_pixel(int row) const;
  /// Returns the place of the rows in the picture and on the grid.
  GridAtPicture grid_at_picture(const RowRange& rows) const;
  ColourImage copy_colours(const Image& picture, const RowRange& rows);
  Image copy_picture(const RowRange& rows) const;

  const RenderOptions& options_;
  kernel::FrameBlock& frame_;
  const std::endian order_;
  AlignedBlock surface_, grid_points_, sample_store_;
};

} // namespace celltrace
