#include "render/blocks.hpp"

#include "celltrace/error.hpp"
#include "celltrace/spe/simd_host.hpp"
#include "kernel/program/block_encoder.hpp"

#include <cstring>

namespace celltrace {

using namespace kernel;

namespace {

using Simd = HostSimd<BaselineArch>;
constexpr std::size_t kBlockBytes = sizeof(EncodedBlock::bytes);

BlockImage make_blocks(int width, int height) {
  BlockImage image;
  image.width = width;
  image.height = height;
  image.blocks.resize(static_cast<std::size_t>(image.columns()) * static_cast<std::size_t>(image.rows()) *
                      kBlockBytes);
  return image;
}

} // namespace

BlockImage copy_blocks(const AlignedBlock& surface, const FrameBlock& frame, int top, int bottom) {
  BlockImage image = make_blocks(static_cast<int>(frame.width), static_cast<int>(frame.height));
  const std::size_t row = frame.packet_columns * kBlockBytes;
  constexpr int kEdge = kPacketEdge;
  for (auto y = static_cast<std::size_t>(top / kEdge);
       y < static_cast<std::size_t>((bottom + kEdge - 1) / kEdge); ++y)
    std::memcpy(image.blocks.data() + y * row, surface.data() + y * frame.surface_pitch, row);
  return image;
}

EncodedPicture encode_blocks(const Image& picture) {
  if (picture.width < 1 || picture.height < 1) throw InputError("a picture without pixels has no blocks");
  EncodedPicture encoded = {make_blocks(picture.width, picture.height), 0};
  const auto width = static_cast<std::uint32_t>(picture.width);
  const auto height = static_cast<std::uint32_t>(picture.height);
  std::uint8_t* to = encoded.blocks.blocks.data();
  for (std::uint32_t y = 0; y < height; y += kPacketEdge)
    for (std::uint32_t x = 0; x < width; x += kPacketEdge, to += kBlockBytes) {
      WordLanes pixels = {};
      for (std::uint32_t lane = 0; lane < kSimdLanes; ++lane) {
        const std::uint32_t column = x + lane % kPacketEdge, line = y + lane / kPacketEdge;
        if (column < width && line < height)
          std::memcpy(&pixels.lane[lane], picture.pixel(static_cast<int>(column), static_cast<int>(line)), 4);
      }
      const std::uint32_t lanes = extend_pixels(x, y, width, height, pixels);
      EncodedBlock block;
      encode_block<Simd>(pixels, lanes, block);
      std::memcpy(to, block.bytes, kBlockBytes);
      encoded.error += block.error;
    }
  return encoded;
}

} // namespace celltrace
