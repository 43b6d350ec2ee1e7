#include "render/first_hits.hpp"

#include "celltrace/spe/byte_order.hpp"
#include "records/material.hpp"

#include <cstddef>
#include <cstring>
#include <limits>

namespace celltrace {

using namespace kernel;

FirstHits read_first_hits(const AlignedBlock& grid_points, const FrameBlock& frame, const Image& picture,
                          const GridAtPicture& grid, std::endian order, const SceneImage& image) {
  const std::size_t pixels = picture.rgba.size() / 4;
  FirstHits hits;
  hits.width = picture.width;
  hits.height = picture.height;
  hits.depth.assign(pixels, std::numeric_limits<float>::infinity());
  hits.normal.assign(3 * pixels, 0);
  hits.object.assign(pixels, 0);
  const std::byte* const table =
      grid_points.data() + std::size_t{frame.packet_columns} * frame.surface_rows * kGridPacketBytes;
  for (int y = grid.region.top; y < grid.region.bottom; ++y)
    for (int x = grid.region.left; x < grid.region.right; ++x) {
      if (picture.pixel(x, y)[3] == 0) continue;
      const std::uint32_t column = grid.first_column + static_cast<std::uint32_t>(x - grid.region.left);
      const std::uint32_t row = grid.first_row + static_cast<std::uint32_t>(y - grid.region.top);
      const std::size_t packet = std::size_t{row / kPacketEdge} * frame.packet_columns + column / kPacketEdge;
      const std::size_t lane = row % kPacketEdge * kPacketEdge + column % kPacketEdge;
      const std::byte* const record = table + packet * sizeof(FirstHitRecord);
      const auto word = [&](std::size_t offset, auto value) {
        std::memcpy(&value, record + offset + lane * sizeof value, sizeof value);
        reorder(value, order);
        return value;
      };
      const auto interior = word(offsetof(FirstHitRecord, interior), std::uint32_t{});
      if (interior == kNoOffset) continue;
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
      hits.depth[pixel] = word(offsetof(FirstHitRecord, distance), float{});
      for (std::size_t axis = 0; axis < 3; ++axis)
        hits.normal[3 * pixel + axis] =
            word(offsetof(FirstHitRecord, normal) + axis * sizeof(FirstHitRecord::normal[0]), float{});
      hits.object[pixel] = 1 + (interior - image.header().interior_offset) /
                                   static_cast<std::uint32_t>(sizeof(InteriorRecord));
    }
  return hits;
}

} // namespace celltrace
