// The picture as the SPEs put it to main memory, and what becomes of it on the PPE's side.
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

/// Pixels, colours, the points of a grid and the SPEs' room for samples: whichever a picture needs.
class PictureMemory {
public:
  /// Of pictures as `options` are at the time of each call. `frame` is the PPE's.
  PictureMemory(const RenderOptions& options, kernel::FrameBlock& frame, std::endian order)
      : options_(options), frame_(frame), order_(order) {}

  /// What the options need; the frame block is told where it lies. What was there is lost.
  void make_room(unsigned spes, std::uint32_t bundle_edge);
  /// Makes the memory begin with these rows, if it has room for a part of the picture only. Points of the
  /// grid from there to line `kept` (excluded) stay, if there are any.
  void begin_at(const RowRange& rows, std::uint32_t kept);
  /// All of them.
  RowRange rows() const;
  /// Makes points from this line of the grid on transparent black, and all colours. Lines before those that
  /// the memory has count as its first one.
  void clear_from(std::uint32_t line);
  /// How this frame's blocks lie in the picture.
  BlockGrid blocks(std::uint32_t bundle_edge) const;
  /// Calls RenderOptions::finished_block for each.
  void tell_blocks(const std::vector<PictureRegion>& regions, unsigned spe) const;
  /// The colours of the grid's points become those of pixels, if they are wanted; in the SPEs' byte order.
  void keep_colours(const RowRange& rows);
  /// Fills in what the options ask for.
  void copy(const RowRange& rows, const SceneImage& image, RenderResult& result);

private:
  void make_room_for_samples(unsigned spes, std::uint32_t bundle_edge);
  bool has_whole_picture() const;
  /// Returns the grid's line that is the first one in memory.
  std::uint32_t first_line() const;
  std::byte* line_of_surface(std::uint32_t line) const;
  std::byte* line_of_colours(std::uint32_t line) const;
  std::byte* row_of_points(std::uint32_t packet_row) const;
  /// Returns where rows of the region go to: in pictures of the whole, or of these rows alone.
  PictureRegion place_in_result(const RowRange& rows) const;
  /// Makes a picture for the result, opaque black.
  template <class Picture> Picture make_picture(const RowRange& rows) const;
  /// Whether the grid begins to the upper left of the picture, as that of the fixed method does.
  bool begins_before_picture() const;
  /// Returns where a row of the region begins.
  const std::uint8_t* first_pixel(int row) const;
  /// Where the rows are in the picture and in the grid.
  GridAtPicture grid_at_picture(const RowRange& rows) const;
  ColourImage copy_colours(const Image& picture, const RowRange& rows);
  Image copy_picture(const RowRange& rows) const;

  const RenderOptions& options_;
  kernel::FrameBlock& frame_;
  const std::endian order_;
  AlignedBlock surface_, grid_points_, sample_store_;
};

} // namespace celltrace
