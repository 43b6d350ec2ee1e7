#include "render/picture_memory.hpp"

#include "celltrace/spe/byte_order.hpp"
#include "kernel/program/pixel_sampler.hpp"
#include "render/blocks.hpp"
#include "render/frame_setup.hpp"
#include "scene/scene_image.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace celltrace {

using namespace kernel;

namespace {

/// A block that a DMA list can address: all of it in one region of 4 GB.
AlignedBlock make_list_target(std::size_t bytes) {
  AlignedBlock block = AlignedBlock::uninitialised(bytes, Pages::normal);
  const auto region = [](const std::byte* at) { return reinterpret_cast<std::uintptr_t>(at) >> 31 >> 1; };
  // The block that straddles a border is kept while another one is made, which therefore lies elsewhere.
  if (region(block.data()) != region(block.data() + bytes - 1)) return make_list_target(bytes);
  return block;
}

} // namespace

void PictureMemory::make_room(unsigned spes, std::uint32_t bundle_edge) {
  surface_ = make_list_target(std::size_t{frame_.surface_pitch + frame_.sampling.colours_pitch} *
                              frame_.packet_rows * kPacketEdge);
  frame_.surface = to_ea(surface_.data());
  grid_points_ = AlignedBlock();
  if (options_.antialiasing || brings_colours(options_))
    grid_points_ = AlignedBlock::uninitialised(
        std::size_t{frame_.packet_columns} * frame_.packet_rows *
            (kGridPacketBytes + (options_.first_hits ? sizeof(FirstHitRecord) : 0)),
        Pages::normal);
  frame_.grid_points = to_ea(grid_points_.data());
  if (options_.antialiasing) make_room_for_samples(spes, bundle_edge);
}

void PictureMemory::make_room_for_samples(unsigned spes, std::uint32_t bundle_edge) {
  const std::size_t bytes = std::size_t{spes} * sample_store_bytes(bundle_edge, options_.alpha);
  if (sample_store_.size() >= bytes) return; // it does not depend on the picture's size
  sample_store_ = AlignedBlock::uninitialised(bytes, Pages::normal);
  frame_.sample_store = to_ea(sample_store_.data());
}

RowRange PictureMemory::rows() const {
  const PictureRegion region = region_of(options_);
  return {0, region.bottom - region.top};
}

void PictureMemory::clear_from(std::uint32_t line) {
  const std::size_t kept = std::size_t{frame_.surface_pitch} * line;
  std::memset(surface_.data() + kept, 0, surface_.size() - kept);
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

void PictureMemory::tell_blocks(const std::vector<PictureRegion>& regions, unsigned spe) const {
  const PictureRegion picture = region_of(options_);
  for (const PictureRegion& region : regions)
    options_.finished_block(
        {region,
         first_pixel() +
             std::size_t{frame_.surface_pitch} * static_cast<std::size_t>(region.top - picture.top) +
             std::size_t{4} * static_cast<std::size_t>(region.left - picture.left),
         frame_.surface_pitch, spe});
}

const std::uint8_t* PictureMemory::first_pixel() const {
  const auto* first = reinterpret_cast<const std::uint8_t*>(surface_.data());
  return begins_before_picture() ? first + frame_.surface_pitch + 4 : first;
}

std::byte* PictureMemory::rows_of_colours() {
  return surface_.data() + std::size_t{frame_.surface_pitch} * frame_.packet_rows * kPacketEdge;
}

void PictureMemory::keep_colours(const RowRange& rows) {
  if (!brings_colours(options_)) return;
  constexpr std::uint32_t kPoints = kPacketEdge * kPacketEdge;
  const std::uint32_t first = static_cast<std::uint32_t>(rows.top) / kPacketEdge;
  const std::uint32_t lines = static_cast<std::uint32_t>(rows.bottom) + (options_.antialiasing ? 1 : 0);
  const std::byte* from = grid_points_.data() + std::size_t{first} * frame_.packet_columns * kGridPacketBytes;
  for (std::uint32_t row = first; row < (lines + kPacketEdge - 1) / kPacketEdge; ++row)
    for (std::uint32_t column = 0; column < frame_.packet_columns; ++column, from += kGridPacketBytes)
      for (std::uint32_t point = 0; point < kPoints; ++point) {
        const std::uint32_t x = column * kPacketEdge + point % kPacketEdge;
        const std::uint32_t y = row * kPacketEdge + point / kPacketEdge;
        std::byte* const to =
            rows_of_colours() + std::size_t{y} * frame_.sampling.colours_pitch + x * sizeof(ColourRecord);
        for (std::size_t channel = 0; channel < 4; ++channel)
          std::memcpy(to + channel * sizeof(float), from + (channel * kPoints + point) * sizeof(float),
                      sizeof(float));
      }
}

/// The host encodes pixels that have alpha.
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

GridAtPicture PictureMemory::grid_at_picture(const RowRange& rows) const {
  GridAtPicture grid;
  const PictureRegion region = region_of(options_);
  grid.region = {region.left, region.right, region.top + rows.top, region.top + rows.bottom};
  grid.first_column = begins_before_picture() ? 1 : 0;
  grid.first_row = grid.first_column + static_cast<std::uint32_t>(rows.top);
  return grid;
}

/// Where the picture has not been rendered, so have the colours not.
ColourImage PictureMemory::copy_colours(const Image& picture, const RowRange& rows) {
  ColourImage colours(picture.width, picture.height);
  if (options_.alpha)
    for (std::size_t alpha = 3; alpha < colours.rgba.size(); alpha += 4)
      colours.rgba[alpha] = 0;
  if (static_cast<GammaEncoding>(frame_.gamma_encoding) == GammaEncoding::none)
    colours.gamma = std::nullopt;
  else
    colours.gamma = static_cast<double>(frame_.assumed_gamma);
  const PictureRegion region = region_of(options_);
  const std::size_t pitch = frame_.sampling.colours_pitch;
  const std::byte* from = rows_of_colours() + pitch * static_cast<std::size_t>(rows.top);
  if (begins_before_picture()) from += pitch + sizeof(ColourRecord);
  for (int y = region.top + rows.top; y < region.top + rows.bottom; ++y, from += pitch)
    for (int x = region.left; x < region.right; ++x) {
      float* const pixel = colours.pixel(x, y);
      if (picture.pixel(x, y)[3] == 0) {
        pixel[3] = 0;
        continue;
      }
      float channels[4];
      std::memcpy(channels, from + static_cast<std::size_t>(x - region.left) * sizeof(ColourRecord),
                  sizeof channels);
      reorder(channels, order_);
      std::copy_n(channels, 3, pixel);
      if (options_.alpha) pixel[3] = 1 - channels[3];
    }
  return colours;
}

Image PictureMemory::copy_picture(const RowRange& rows) const {
  const std::uint8_t* from =
      first_pixel() + std::size_t{frame_.surface_pitch} * static_cast<std::size_t>(rows.top);
  const PictureRegion region = region_of(options_);
  const std::size_t row = std::size_t{4} * static_cast<std::size_t>(region.right - region.left);
  if (options_.region || rows != this->rows()) {
    Image image(options_.width, options_.height);
    for (int y = rows.top; y < rows.bottom; ++y, from += frame_.surface_pitch)
      std::memcpy(image.pixel(region.left, region.top + y), from, row);
    return image;
  }
  Image image;
  image.width = options_.width;
  image.height = options_.height;
  image.rgba.reserve(row * static_cast<std::size_t>(options_.height));
  for (int y = 0; y < options_.height; ++y, from += frame_.surface_pitch)
    image.rgba.insert(image.rgba.end(), from, from + row);
  return image;
}

} // namespace celltrace
