// PNG out, after the specification (ISO/IEC 15948). libpng would compress by zlib, which takes three times as
// long as libdeflate for larger files; the rest of a file is a header, checksums and differences of rows.
#include "image/formats.hpp"
#include "image/limits.hpp"

#include <cstring>
#include <limits>
#include <memory>
#include <new>

#include <libdeflate.h>

namespace celltrace::image {

namespace {

/// libdeflate's levels 2 to 4 are equally fast on rendered pictures; below, it is slower and compresses less.
constexpr int kLevel = 4;

constexpr std::uint8_t kFilterUp = 2;
constexpr std::uint8_t kColourRgb = 2, kColourRgba = 6;

using Bytes = std::unique_ptr<std::uint8_t[]>;

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

void put_big_endian(std::uint8_t* target, std::uint32_t value) {
  for (int i = 0; i < 4; ++i)
    target[i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

void write_chunk(std::FILE* file, const char (&type)[5], const std::uint8_t* data, std::size_t count) {
  std::uint8_t front[8], checksum[4];
  put_big_endian(front, static_cast<std::uint32_t>(count));
  std::memcpy(front + 4, type, 4);
  std::uint32_t crc = libdeflate_crc32(0, front + 4, 4);
  if (count > 0) crc = libdeflate_crc32(crc, data, count);
  put_big_endian(checksum, crc);
  write_bytes(file, front, sizeof front);
  if (count > 0) write_bytes(file, data, count);
  write_bytes(file, checksum, sizeof checksum);
}

template <class Channel> void write_header(std::FILE* file, const BasicImage<Channel>& image, bool opaque) {
  constexpr std::uint8_t kSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  write_bytes(file, kSignature, sizeof kSignature);
  std::uint8_t header[13] = {}; // deflate, the five filters, not interlaced
  put_big_endian(header, static_cast<std::uint32_t>(image.width));
  put_big_endian(header + 4, static_cast<std::uint32_t>(image.height));
  header[8] = 8 * sizeof(Channel);
  header[9] = opaque ? kColourRgb : kColourRgba;
  write_chunk(file, "IHDR", header, sizeof header);
}

/// The difference of a row and the one above, pixel by pixel: filter type Up.
template <int channels, class Channel>
void filter_row(const Channel* row, const Channel* above, std::uint8_t* target, int width) {
  for (int x = 0; x < width; ++x)
    for (int channel = 0; channel < channels; ++channel) {
      const Channel value = row[4 * x + channel], before = above[4 * x + channel];
      std::uint8_t* const bytes = target + static_cast<int>(sizeof(Channel)) * (channels * x + channel);
      if constexpr (sizeof(Channel) == 2) bytes[0] = static_cast<std::uint8_t>((value >> 8) - (before >> 8));
      bytes[sizeof(Channel) - 1] = static_cast<std::uint8_t>(value - before);
    }
}

/// The bytes that are compressed: each row behind the number of its filter.
template <class Channel> Bytes filtered(const BasicImage<Channel>& image, bool opaque, std::size_t& count) {
  const std::size_t row_bytes = (opaque ? 3 : 4) * sizeof(Channel) * static_cast<std::size_t>(image.width);
  count = (1 + row_bytes) * static_cast<std::size_t>(image.height);
  Bytes bytes = std::make_unique_for_overwrite<std::uint8_t[]>(count);
  const std::vector<Channel> zeros(4 * static_cast<std::size_t>(image.width));
  std::uint8_t* target = bytes.get();
  for (int y = 0; y < image.height; ++y) {
    const Channel* above = y == 0 ? zeros.data() : image.pixel(0, y - 1);
    *target++ = kFilterUp;
    (opaque ? filter_row<3, Channel> : filter_row<4, Channel>)(image.pixel(0, y), above, target, image.width);
    target += row_bytes;
  }
  return bytes;
}

template <class Channel> void write_pixels(std::FILE* file, const BasicImage<Channel>& image, bool opaque) {
  const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
      libdeflate_alloc_compressor(kLevel));
  if (!compressor) throw std::bad_alloc();
  std::size_t count = 0;
  const Bytes pixels = filtered(image, opaque, count);
  const std::size_t most = libdeflate_zlib_compress_bound(compressor.get(), count);
  const Bytes compressed = std::make_unique_for_overwrite<std::uint8_t[]>(most);
  // The largest picture stays far below the 2^31 - 1 bytes a chunk can hold.
  const std::size_t size =
      libdeflate_zlib_compress(compressor.get(), pixels.get(), count, compressed.get(), most);
  write_chunk(file, "IDAT", compressed.get(), size);
}

template <class Channel> bool is_opaque(const BasicImage<Channel>& image) {
  constexpr Channel kOpaque = std::numeric_limits<Channel>::max();
  Channel all = kOpaque;
  for (std::size_t alpha = 3; alpha < image.rgba.size(); alpha += 4)
    all &= image.rgba[alpha];
  return all == kOpaque;
}

} // namespace

template <class Channel> void write_png(std::FILE* file, const BasicImage<Channel>& image) {
  const bool opaque = is_opaque(image);
  write_header(file, image, opaque);
  write_pixels(file, image, opaque);
  write_chunk(file, "IEND", nullptr, 0);
}
template void write_png(std::FILE* file, const Image& image);
template void write_png(std::FILE* file, const DeepImage& image);

} // namespace celltrace::image
