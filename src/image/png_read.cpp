// Reads PNG by libpng. libpng leaves by longjmp when it fails; functions here that call setjmp therefore
// have no locals with a destructor, and owners live in their callers.
#include "image/formats.hpp"
#include "image/limits.hpp"

#include <csetjmp>
#include <cstring>

#include <png.h>

namespace celltrace::image {

namespace {

/// Most bytes of pixel data that a byte of a deflate stream can stand for.
constexpr std::uintmax_t kMaxDeflateRatio = 1032;

struct Message {
  char text[160] = "";
};

void keep_message(png_structp png, png_const_charp text) {
  auto* message = static_cast<Message*>(png_get_error_ptr(png));
  std::strncpy(message->text, text, sizeof message->text - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {
}

struct Reader {
  Message message;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, keep_message, ignore_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;

  Reader() = default;
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void fail(const Message& message) {
  throw InputError(std::string("is damaged: ") + (message.text[0] ? message.text : "unknown error"));
}

/// Reads the file up to the pixels, and selects 8-bit RGBA.
bool read_header(png_structp png, png_infop info, std::FILE* file) {
  if (setjmp(png_jmpbuf(png))) return false;
  // check_size() reports sizes; libpng's own limits would give a worse message.
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_chunk_malloc_max(png, 8u << 20);
  png_set_chunk_cache_max(png, 64);
  png_init_io(png, file);
  png_read_info(png, info);
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
  return true;
}

bool read_pixels(png_structp png, png_infop info, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

/// Throws if the file is too small for its picture, before memory is taken for it.
void check_plausible(png_structp png, png_infop info, std::uintmax_t file_bytes) {
  const std::uintmax_t bits_per_pixel =
      std::uintmax_t{png_get_bit_depth(png, info)} * png_get_channels(png, info);
  const std::uintmax_t row_bytes = (png_get_image_width(png, info) * bits_per_pixel + 7) / 8;
  if (row_bytes * png_get_image_height(png, info) / kMaxDeflateRatio > file_bytes)
    throw InputError("is too short for the size it declares");
}

} // namespace

Image read_png(std::FILE* file, std::uintmax_t file_bytes) {
  Reader reader;
  if (!reader.info) throw std::bad_alloc();
  if (!read_header(reader.png, reader.info, file)) fail(reader.message);
  const png_uint_32 width = png_get_image_width(reader.png, reader.info);
  const png_uint_32 height = png_get_image_height(reader.png, reader.info);
  check_size(width, height);
  check_plausible(reader.png, reader.info, file_bytes);

  Image image(static_cast<int>(width), static_cast<int>(height));
  std::vector<png_bytep> rows(height);
  for (int y = 0; y < image.height; ++y)
    rows[static_cast<std::size_t>(y)] = image.pixel(0, y);
  if (!read_pixels(reader.png, reader.info, rows.data())) fail(reader.message);
  return image;
}

} // namespace celltrace::image
