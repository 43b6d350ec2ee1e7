// Writes DirectDraw surfaces of format DXT1, and converts their blocks to pixels. The header is that of
// Microsoft's "Programming guide for DDS".
#include "image/formats.hpp"
#include "image/limits.hpp"

#include <array>

namespace celltrace::image {

namespace {

/// The words of the header, the magic number first.
using DdsHeader = std::array<std::uint32_t, 32>;

constexpr std::uint32_t four_characters(const char (&text)[5]) {
  std::uint32_t word = 0;
  for (int i = 3; i >= 0; --i)
    word = word << 8 | static_cast<std::uint8_t>(text[i]);
  return word;
}

/// Returns red, green and blue from 5, 6 and 5 bits.
std::array<int, 3> colour_of(unsigned end) {
  const unsigned red = end >> 11, green = end >> 5 & 63, blue = end & 31;
  return {static_cast<int>(red << 3 | red >> 2), static_cast<int>(green << 2 | green >> 4),
          static_cast<int>(blue << 3 | blue >> 2)};
}

void decode_block(const std::uint8_t* block, int x, int y, Image& image) {
  const unsigned ends[2] = {block[0] + 256u * block[1], block[2] + 256u * block[3]};
  std::array<int, 3> colours[4] = {colour_of(ends[0]), colour_of(ends[1]), {}, {}};
  const bool has_four = ends[0] > ends[1];
  for (std::size_t i = 0; i < 3; ++i) {
    const int first = colours[0][i], second = colours[1][i];
    colours[2][i] = has_four ? (2 * first + second) / 3 : (first + second) / 2;
    if (has_four) colours[3][i] = (first + 2 * second) / 3;
  }
  for (int row = 0; row < 4 && y + row < image.height; ++row)
    for (int column = 0; column < 4 && x + column < image.width; ++column) {
      const auto& colour = colours[block[4 + row] >> 2 * column & 3];
      for (std::size_t i = 0; i < 3; ++i)
        image.pixel(x + column, y + row)[i] = static_cast<std::uint8_t>(colour[i]);
    }
}

} // namespace

void check_blocks(const BlockImage& blocks) {
  check_size(blocks.width, blocks.height);
  if (blocks.blocks.size() !=
      8 * static_cast<std::size_t>(blocks.columns()) * static_cast<std::size_t>(blocks.rows()))
    throw InputError("a picture's blocks do not match its size");
}

void write_dds(std::FILE* file, const BlockImage& blocks) {
  constexpr std::uint32_t kCaps = 0x1, kHeight = 0x2, kWidth = 0x4, kPixelFormat = 0x1000,
                          kLinearSize = 0x80000;
  constexpr std::uint32_t kFourCharacters = 0x4, kTexture = 0x1000;
  DdsHeader header = {};
  header[0] = four_characters("DDS ");
  header[1] = 124; // bytes of the header from here on
  header[2] = kCaps | kHeight | kWidth | kPixelFormat | kLinearSize;
  header[3] = static_cast<std::uint32_t>(blocks.height);
  header[4] = static_cast<std::uint32_t>(blocks.width);
  header[5] = static_cast<std::uint32_t>(blocks.blocks.size());
  header[19] = 32; // bytes of the pixel format
  header[20] = kFourCharacters;
  header[21] = four_characters("DXT1");
  header[27] = kTexture;
  std::vector<std::uint8_t> bytes;
  for (const std::uint32_t word : header)
    for (int shift = 0; shift < 32; shift += 8)
      bytes.push_back(static_cast<std::uint8_t>(word >> shift));
  write_bytes(file, bytes.data(), bytes.size());
  write_bytes(file, blocks.blocks.data(), blocks.blocks.size());
}

} // namespace celltrace::image

namespace celltrace {

Image to_image(const BlockImage& blocks) {
  image::check_blocks(blocks);
  Image image(blocks.width, blocks.height);
  const std::uint8_t* block = blocks.blocks.data();
  for (int y = 0; y < blocks.height; y += 4)
    for (int x = 0; x < blocks.width; x += 4, block += 8)
      image::decode_block(block, x, y, image);
  return image;
}

} // namespace celltrace
