#include "render/picture_memory.hpp"

#include "celltrace/spe/byte_order.hpp"
#include "celltrace/spe/machine.hpp"
#include "kernel/program/pixel_sampler.hpp"
#include "render/blocks.hpp"
#include "render/picture_options.hpp"
#include "scene_image/scene_image.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace celltrace {

using namespace kernel;

namespace {

/// Returns a block that lies in one region of 4 GB, so that a DMA list can address it.
AlignedBlock make_list_target(std::size_t bytes) {
  AlignedBlock block = AlignedBlock::uninitialised(bytes, Pages::normal);
  const auto region = [](const std::byte* at) { return reinterpret_cast<std::uintptr_t>(at) >> 31 >> 1; };
  // A block that straddles a border lives until the next block is made, so that the next block lies
  // elsewhere.
  if (region(block.data()) != region(block.data() + bytes - 1)) return make_list_target(bytes);
  return block;
}

/// Returns the number of rows of packets that render_rows() may need at a time: the rows of whole bundles.
std::uint32_t rows_in_memory(const RenderOptions& options, const FrameBlock& frame,
                             std::uint32_t bundle_edge) {
  if (options.rows_at_once == 0) return frame.packet_rows;
  const std::uint32_t lines =
      static_cast<std::uint32_t>(options.rows_at_once) + (options.antialiasing ? 1 : 0);
  const std::uint32_t height = bundle_edge * kPacketEdge;
  return std::min(frame.packet_rows, (lines + height - 1) / height * bundle_edge);
}

} // namespace

void PictureMemory::make_room(unsigned spes, std::uint32_t bundle_edge) {
  frame_.surface_row = 0;
  frame_.surface_rows = static_cast<std::uint16_t>(rows_in_memory(options_, frame_, bundle_edge));
  surface_ = make_list_target(std::size_t{frame_.surface_pitch + frame_.sampling.colours_pitch} *
                              frame_.surface_rows * kPacketEdge);
  frame_.surface = to_ea(surface_.data());
  grid_points_ = AlignedBlock();
  if (options_.antialiasing || brings_colours(options_))
    grid_points_ = AlignedBlock::uninitialised(
        std::size_t{frame_.packet_columns} * frame_.surface_rows *
            (kGridPacketBytes + (options_.first_hits ? sizeof(FirstHitRecord) : 0)),
        Pages::normal);
  frame_.grid_points = to_ea(grid_points_.data());
  if (options_.antialiasing) make_room_for_samples(spes, bundle_edge);
}

void PictureMemory::make_room_for_samples(unsigned spes, std::uint32_t bundle_edge) {
  const std::size_t bytes = std::size_t{spes} * sample_store_bytes(bundle_edge, options_.alpha);
  if (sample_store_.size() >= bytes) return; // its size does not depend on the picture's
  sample_store_ = AlignedBlock::uninitialised(bytes, Pages::normal);
  frame_.sample_store = to_ea(sample_store_.data());
}

void PictureMemory::begin_at(const RowRange& rows, std::uint32_t kept) {
  if (has_whole_picture()) return;
  const std::uint32_t first = static_cast<std::uint32_t>(rows.top), row = first / kPacketEdge;
  if (kept > first) {
    const std::uint32_t packet_rows = (kept - first) / kPacketEdge;
    std::memmove(surface_.data(), line_of_surface(first), std::size_t{frame_.surface_pitch} * (kept - first));
    if (grid_points_.size() != 0)
      std::memmove(grid_points_.data(), row_of_points(row),
                   std::size_t{kGridPacketBytes} * frame_.packet_columns * packet_rows);
    if (options_.first_hits) {
      const std::size_t row_bytes = sizeof(FirstHitRecord) * frame_.packet_columns;
      std::byte* const table =
          grid_points_.data() + std::size_t{kGridPacketBytes} * frame_.packet_columns * frame_.surface_rows;
      std::memmove(table, table + row_bytes * (row - frame_.surface_row), row_bytes * packet_rows);
    }
  }
  frame_.surface_row = static_cast<std::uint16_t>(row);
}

RowRange PictureMemory::rows() const {
  const PictureRegion region = region_of(options_);
  return {0, region.bottom - region.top};
}

bool PictureMemory::has_whole_picture() const {
  return frame_.surface_rows == frame_.packet_rows;
}
std::uint32_t PictureMemory::first_line() const {
  return frame_.surface_row * kPacketEdge;
}
std::byte* PictureMemory::line_of_surface(std::uint32_t line) const {
  return surface_.data() + std::size_t{frame_.surface_pitch} * (line - first_line());
}
std::byte* PictureMemory::line_of_colours(std::uint32_t line) const {
  return surface_.data() + std::size_t{frame_.surface_pitch} * frame_.surface_rows * kPacketEdge +
         std::size_t{frame_.sampling.colours_pitch} * (line - first_line());
}
std::byte* PictureMemory::row_of_points(std::uint32_t packet_row) const {
  return grid_points_.data() +
         std::size_t{kGridPacketBytes} * frame_.packet_columns * (packet_row - frame_.surface_row);
}

void PictureMemory::clear_from(std::uint32_t line) {
  std::byte* const begin = line_of_surface(std::max(line, first_line()));
  std::memset(begin, 0, static_cast<std::size_t>(surface_.data() + surface_.size() - begin));
}

bool PictureMemory::begins_before_picture() const {
  const auto& antialiasing = options_.antialiasing;
  return antialiasing && antialiasing->method == Antialiasing::Method::fixed;
}

BlockGrid PictureMemory::blocks(std::uint32_t bundle_edge) const {
  BlockGrid grid;
  grid.region = region_of(options_);
  grid.columns = frame_.bundle_columns;
  grid.left = grid.region.left;
  grid.top = grid.region.top;
  if (static_cast<FramePurpose>(frame_.purpose) == FramePurpose::samples) {
    grid.edge = static_cast<int>(kSampledEdge);
    return grid;
  }
  grid.edge = static_cast<int>(bundle_edge * kPacketEdge);
  if (begins_before_picture()) {
    --grid.left;
    --grid.top;
  }
  return grid;
}

void PictureMemory::report_blocks(const std::vector<PictureRegion>& regions, unsigned spe) const {
  const PictureRegion picture = region_of(options_);
  for (const PictureRegion& region : regions)
    options_.finished_block({region,
                             first_pixel(region.top - picture.top) +
                                 std::size_t{4} * static_cast<std::size_t>(region.left - picture.left),
                             frame_.surface_pitch, spe});
}

const std::uint8_t* PictureMemory::first_pixel(int row) const {
  const std::uint32_t before = begins_before_picture() ? 1 : 0;
  return reinterpret_cast<const std::uint8_t*>(line_of_surface(static_cast<std::uint32_t>(row) + before)) +
         std::size_t{4} * before;
}

void PictureMemory::keep_colours(const RowRange& rows) {
  if (!brings_colours(options_)) return;
  constexpr std::uint32_t kPoints = kPacketEdge * kPacketEdge;
  const std::uint32_t first = static_cast<std::uint32_t>(rows.top) / kPacketEdge;
  const std::uint32_t lines = static_cast<std::uint32_t>(rows.bottom) + (options_.antialiasing ? 1 : 0);
  const std::byte* from = row_of_points(first);
  for (std::uint32_t row = first; row < (lines + kPacketEdge - 1) / kPacketEdge; ++row)
    for (std::uint32_t column = 0; column < frame_.packet_columns; ++column, from += kGridPacketBytes)
      for (std::uint32_t point = 0; point < kPoints; ++point) {
        const std::uint32_t x = column * kPacketEdge + point % kPacketEdge;
        const std::uint32_t y = row * kPacketEdge + point / kPacketEdge;
        std::byte* const to = line_of_colours(y) + x * sizeof(ColourRecord);
        for (std::size_t channel = 0; channel < 4; ++channel)
          std::memcpy(to + channel * sizeof(float), from + (channel * kPoints + point) * sizeof(float),
                      sizeof(float));
      }
}

/// Copies to the result; the host encodes blocks of pixels that have alpha.
void PictureMemory::copy(const RowRange& rows, const SceneImage& image, RenderResult& result) {
  if (options_.blocks) {
    result.blocks = copy_blocks(surface_, frame_, rows.top, rows.bottom);
    result.image = to_image(result.blocks);
    return;
  }
  result.image = copy_picture(rows);
  if (!brings_colours(options_)) return;
  ColourImage colours = copy_colours(result.image, rows);
  if (options_.first_hits)
    result.first_hits =
        read_first_hits(grid_points_, frame_, result.image, grid_at_picture(rows), order_, image);
  if (options_.alpha) result.image = to_image(colours);
  if (options_.colours) result.colours = std::move(colours);
}

PictureRegion PictureMemory::place_in_result(const RowRange& rows) const {
  PictureRegion place = region_of(options_);
  if (options_.rows_at_once != 0) return {0, place.right - place.left, 0, rows.bottom - rows.top};
  place.bottom = place.top + rows.bottom;
  place.top += rows.top;
  return place;
}

template <class Picture> Picture PictureMemory::make_picture(const RowRange& rows) const {
  if (options_.rows_at_once == 0) return Picture(options_.width, options_.height);
  const PictureRegion place = place_in_result(rows);
  return Picture(place.right, place.bottom);
}

GridAtPicture PictureMemory::grid_at_picture(const RowRange& rows) const {
  GridAtPicture grid;
  grid.region = place_in_result(rows);
  grid.first_column = begins_before_picture() ? 1 : 0;
  grid.first_row = grid.first_column + static_cast<std::uint32_t>(rows.top) - first_line();
  return grid;
}

/// Copies colours, except where the picture has not been rendered.
ColourImage PictureMemory::copy_colours(const Image& picture, const RowRange& rows) {
  auto colours = make_picture<ColourImage>(rows);
  if (options_.alpha)
    for (std::size_t alpha = 3; alpha < colours.rgba.size(); alpha += 4)
      colours.rgba[alpha] = 0;
  if (static_cast<GammaEncoding>(frame_.gamma_encoding) == GammaEncoding::none)
    colours.gamma = std::nullopt;
  else
    colours.gamma = static_cast<double>(frame_.assumed_gamma);
  const PictureRegion place = place_in_result(rows);
  const std::size_t pitch = frame_.sampling.colours_pitch;
  const std::uint32_t before = begins_before_picture() ? 1 : 0;
  const std::byte* from =
      line_of_colours(static_cast<std::uint32_t>(rows.top) + before) + before * sizeof(ColourRecord);
  for (int y = place.top; y < place.bottom; ++y, from += pitch)
    for (int x = place.left; x < place.right; ++x) {
      float* const pixel = colours.pixel(x, y);
      if (picture.pixel(x, y)[3] == 0) {
        pixel[3] = 0;
        continue;
      }
      float channels[4];
      std::memcpy(channels, from + static_cast<std::size_t>(x - place.left) * sizeof(ColourRecord),
                  sizeof channels);
      reorder(channels, order_);
      std::copy_n(channels, 3, pixel);
      if (options_.alpha) pixel[3] = 1 - channels[3];
    }
  return colours;
}

Image PictureMemory::copy_picture(const RowRange& rows) const {
  const std::uint8_t* from = first_pixel(rows.top);
  const PictureRegion place = place_in_result(rows);
  const std::size_t row = std::size_t{4} * static_cast<std::size_t>(place.right - place.left);
  if (options_.rows_at_once == 0 && (options_.region || rows != this->rows())) {
    Image image(options_.width, options_.height);
    for (int y = place.top; y < place.bottom; ++y, from += frame_.surface_pitch)
      std::memcpy(image.pixel(place.left, y), from, row);
    return image;
  }
  Image image;
  image.width = place.right - place.left;
  image.height = place.bottom - place.top;
  image.rgba.reserve(row * static_cast<std::size_t>(image.height));
  for (int y = place.top; y < place.bottom; ++y, from += frame_.surface_pitch)
    image.rgba.insert(image.rgba.end(), from, from + row);
  return image;
}

} // namespace celltrace
