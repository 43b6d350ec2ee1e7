// Reads JPEG by libjpeg.
#include "image/formats.hpp"
#include "image/jpeg_error.hpp"
#include "image/limits.hpp"

#include <vector>

namespace celltrace::image {

namespace {

/// Most bytes of pixels that a byte of a file can stand for: a block of 8x8 pixels takes some bits.
constexpr std::uintmax_t kMostPixelsOfByte = 2048;

struct Decompressor {
  JpegFailure failure;
  jpeg_decompress_struct info = {};

  Decompressor() { info.err = failure.begin(); }
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;
  ~Decompressor() { jpeg_destroy_decompress(&info); }
};

bool read_header(jpeg_decompress_struct& info, JpegFailure& failure, std::FILE* file) {
  if (setjmp(failure.leave)) return false;
  jpeg_create_decompress(&info);
  jpeg_stdio_src(&info, file);
  jpeg_read_header(&info, TRUE);
  return true;
}

bool begin(jpeg_decompress_struct& info, JpegFailure& failure) {
  if (setjmp(failure.leave)) return false;
  info.out_color_space = JCS_RGB;
  jpeg_start_decompress(&info);
  return true;
}

bool read_row(jpeg_decompress_struct& info, JpegFailure& failure, std::uint8_t* row) {
  if (setjmp(failure.leave)) return false;
  jpeg_read_scanlines(&info, &row, 1);
  return true;
}

void check(const JpegFailure& failure, bool is_done) {
  if (!is_done) throw InputError(std::string("is damaged: ") + failure.text);
}

} // namespace

Image read_jpeg(std::FILE* file, std::uintmax_t file_bytes) {
  Decompressor jpeg;
  check(jpeg.failure, read_header(jpeg.info, jpeg.failure, file));
  check_size(jpeg.info.image_width, jpeg.info.image_height);
  if (std::uintmax_t{jpeg.info.image_width} * jpeg.info.image_height / kMostPixelsOfByte > file_bytes)
    throw InputError("is too short for the size it declares");
  check(jpeg.failure, begin(jpeg.info, jpeg.failure));
  Image image(static_cast<int>(jpeg.info.output_width), static_cast<int>(jpeg.info.output_height));
  std::vector<std::uint8_t> row(3 * static_cast<std::size_t>(image.width));
  for (int y = 0; y < image.height; ++y) {
    check(jpeg.failure, read_row(jpeg.info, jpeg.failure, row.data()));
    for (int x = 0; x < image.width; ++x)
      for (int channel = 0; channel < 3; ++channel)
        image.pixel(x, y)[channel] = row[3 * static_cast<std::size_t>(x) + static_cast<std::size_t>(channel)];
  }
  if (jpeg.info.err->num_warnings > 0) throw InputError("is damaged or truncated");
  return image;
}

} // namespace celltrace::image
