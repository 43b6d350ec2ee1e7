// Reads Truevision's TGA: true colour and grey of 8 bits a channel, plain or run-length encoded. A TGA has no
// magic number; version 2 is recognised by its footer.
#include "image/formats.hpp"
#include "image/limits.hpp"

#include <cstring>
#include <vector>

namespace celltrace::image {

namespace {

constexpr std::size_t kTgaHeader = 18, kTgaFooter = 26;

struct TgaHeader {
  bool is_grey, has_runs, from_the_top, from_the_right;
  std::size_t pixel_bytes;
  int width, height;
  long first; ///< offset of the pixels
};

TgaHeader header_of(const std::uint8_t (&h)[kTgaHeader]) {
  const int type = h[2] & 7, alpha_bits = h[17] & 15;
  const bool is_grey = type == 3;
  if (h[1] != 0 || (type != 2 && type != 3) || (h[2] & ~11) != 0 || alpha_bits % 8 != 0)
    throw InputError("is a TGA of a kind that is not read: with a palette, or not of 8 bits a channel");
  const std::size_t bytes = h[16] / 8;
  const std::size_t expected = is_grey ? 1 : 3;
  if (h[16] % 8 != 0 || (bytes != expected && bytes != expected + 1))
    throw InputError("is a TGA of a kind that is not read: with a palette, or not of 8 bits a channel");
  return {is_grey, (h[2] & 8) != 0,     (h[17] & 0x20) != 0, (h[17] & 0x10) != 0,
          bytes,   h[12] + 256 * h[13], h[14] + 256 * h[15], static_cast<long>(kTgaHeader) + h[0]};
}

/// Reads the pixels of a file, one after the other.
class TgaPixels {
public:
  TgaPixels(std::FILE* file, const TgaHeader& header) : file_(file), header_(header) {}

  /// Returns the next pixel, valid until the next call.
  const std::uint8_t* next() {
    if (header_.has_runs && left_-- == 0) begin_packet();
    if (!header_.has_runs || !is_run_) read(pixel_, header_.pixel_bytes);
    return pixel_;
  }

private:
  void begin_packet() {
    std::uint8_t count = 0;
    read(&count, 1);
    is_run_ = count >= 128;
    left_ = count % 128;
    if (is_run_) read(pixel_, header_.pixel_bytes);
  }
  void read(std::uint8_t* bytes, std::size_t count) {
    if (std::fread(bytes, 1, count, file_) != count) throw InputError("is truncated");
  }

  std::FILE* file_;
  const TgaHeader& header_;
  std::uint8_t pixel_[4] = {};
  bool is_run_ = false;
  int left_ = 0; ///< remaining pixels of a packet
};

} // namespace

bool is_tga(std::FILE* file, std::uintmax_t file_bytes) {
  char footer[kTgaFooter] = {};
  const bool is_read = file_bytes >= kTgaHeader + kTgaFooter &&
                       std::fseek(file, -static_cast<long>(kTgaFooter), SEEK_END) == 0 &&
                       std::fread(footer, 1, kTgaFooter, file) == kTgaFooter;
  std::rewind(file);
  return is_read && std::memcmp(footer + 8, "TRUEVISION-XFILE.", 18) == 0;
}

Image read_tga(std::FILE* file, std::uintmax_t file_bytes) {
  std::uint8_t bytes[kTgaHeader];
  if (std::fread(bytes, 1, kTgaHeader, file) != kTgaHeader) throw InputError("is truncated");
  const TgaHeader header = header_of(bytes);
  check_size(header.width, header.height);
  // Rejects files that are too short: a packet of at most 128 pixels has at least 2 bytes.
  const auto pixels = static_cast<std::uintmax_t>(header.width) * static_cast<std::uintmax_t>(header.height);
  if ((header.has_runs ? pixels / 64 : pixels * header.pixel_bytes) > file_bytes)
    throw InputError("is too short for the size it declares");
  if (std::fseek(file, header.first, SEEK_SET) != 0) throw InputError("is truncated");
  Image image(header.width, header.height);
  TgaPixels from(file, header);
  const bool has_alpha = header.pixel_bytes % 2 == 0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const std::uint8_t* const pixel = from.next();
      std::uint8_t* const target = image.pixel(header.from_the_right ? image.width - 1 - column : column,
                                               header.from_the_top ? row : image.height - 1 - row);
      for (int channel = 0; channel < 3; ++channel)
        target[channel] = header.is_grey ? pixel[0] : pixel[2 - channel];
      if (has_alpha) target[3] = pixel[header.pixel_bytes - 1];
    }
  return image;
}

} // namespace celltrace::image
