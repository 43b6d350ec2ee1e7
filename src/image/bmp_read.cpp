// Reads Windows' bitmaps of 24 and 32 bits a pixel that are not compressed.
#include "image/formats.hpp"
#include "image/limits.hpp"

#include <algorithm>
#include <vector>

namespace celltrace::image {

namespace {

constexpr std::size_t kBmpHeader = 54,
                      kAlphaMask = 66; ///< end of version 3's masks; offset of version 4's alpha mask

std::int64_t number_at(const std::uint8_t* bytes, int count) {
  std::int64_t number = 0;
  for (int i = count - 1; i >= 0; --i)
    number = number << 8 | bytes[i];
  return number;
}

struct BmpHeader {
  std::int64_t first; ///< offset of the pixels in bytes
  int width, height;
  bool from_the_top;
  std::size_t pixel_bytes;
  bool has_alpha;
};

BmpHeader header_of(std::FILE* file) {
  std::uint8_t h[kAlphaMask + 4] = {};
  if (std::fread(h, 1, sizeof h, file) < kBmpHeader) throw InputError("is truncated");
  const std::int64_t info = number_at(h + 14, 4), bits = number_at(h + 28, 2),
                     compression = number_at(h + 30, 4);
  constexpr std::int64_t kInfo = 40, kInfoWithAlpha = 56, kMasks = 3;
  const bool has_masks = compression == kMasks && bits == 32 && number_at(h + 54, 4) == 0xFF0000 &&
                         number_at(h + 58, 4) == 0xFF00 && number_at(h + 62, 4) == 0xFF;
  if (info < kInfo || (bits != 24 && bits != 32) || (compression != 0 && !has_masks))
    throw InputError("is a BMP of a kind that is not read: compressed, or not of 24 or 32 bits a pixel");
  const std::int64_t width = static_cast<std::int32_t>(number_at(h + 18, 4));
  const std::int64_t height = static_cast<std::int32_t>(number_at(h + 22, 4));
  check_size(width, height < 0 ? -height : height);
  const bool has_alpha =
      bits == 32 && (!has_masks || info < kInfoWithAlpha || number_at(h + kAlphaMask, 4) != 0);
  return {number_at(h + 10, 4),
          static_cast<int>(width),
          static_cast<int>(height < 0 ? -height : height),
          height < 0,
          static_cast<std::size_t>(bits / 8),
          has_alpha};
}

/// Drops alpha that is 0 everywhere: the header of version 3 does not say what the fourth byte means.
void drop_empty_alpha(Image& image) {
  for (std::size_t alpha = 3; alpha < image.rgba.size(); alpha += 4)
    if (image.rgba[alpha] != 0) return;
  for (std::size_t alpha = 3; alpha < image.rgba.size(); alpha += 4)
    image.rgba[alpha] = 255;
}

} // namespace

Image read_bmp(std::FILE* file, std::uintmax_t file_bytes) {
  const BmpHeader header = header_of(file);
  const std::size_t row_bytes = (header.pixel_bytes * static_cast<std::size_t>(header.width) + 3) / 4 * 4;
  if (static_cast<std::uintmax_t>(header.first) + row_bytes * static_cast<std::uintmax_t>(header.height) >
      file_bytes)
    throw InputError("is truncated");
  if (std::fseek(file, static_cast<long>(header.first), SEEK_SET) != 0) throw InputError("is truncated");
  Image image(header.width, header.height);
  std::vector<std::uint8_t> row(row_bytes);
  for (int y = 0; y < image.height; ++y) {
    if (std::fread(row.data(), 1, row_bytes, file) != row_bytes) throw InputError("is truncated");
    const std::uint8_t* pixel = row.data();
    for (int x = 0; x < image.width; ++x, pixel += header.pixel_bytes) {
      std::uint8_t* const target = image.pixel(x, header.from_the_top ? y : image.height - 1 - y);
      for (int channel = 0; channel < 3; ++channel)
        target[channel] = pixel[2 - channel];
      if (header.has_alpha) target[3] = pixel[3];
    }
  }
  if (header.has_alpha) drop_empty_alpha(image);
  return image;
}

} // namespace celltrace::image
