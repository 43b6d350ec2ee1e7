// Reads PNG by libpng. libpng leaves by longjmp when it fails; functions here that call setjmp therefore
// have no locals with a destructor, and owners live in their callers.
#include "image/formats.hpp"
#include "image/limits.hpp"
#include "image/source_image.hpp"

#include <algorithm>
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

namespace {

/// The contents of a PNG's header.
struct SourceHeader {
  png_uint_32 width = 0, height = 0;
  int bits = 8, colours = 0;
  double gamma = 0; ///< of the chunk gAMA; 0: there is none
  bool is_srgb = false, has_alpha = false;
  int palette_size = 0;
};

struct ByteSource {
  const std::string* text;
  std::size_t next = 0;
};

void read_from_bytes(png_structp png, png_bytep to, png_size_t count) {
  auto* bytes = static_cast<ByteSource*>(png_get_io_ptr(png));
  if (count > bytes->text->size() - bytes->next) png_error(png, "the file ends early");
  std::memcpy(to, bytes->text->data() + bytes->next, count);
  bytes->next += count;
}

/// Reads the header, and selects 16-bit RGBA, or the indices if `raw` and there is a palette.
bool read_source_header(png_structp png, png_infop info, ByteSource* bytes, bool raw, SourceHeader* header) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_chunk_malloc_max(png, 8u << 20);
  png_set_chunk_cache_max(png, 64);
  png_set_read_fn(png, bytes, read_from_bytes);
  png_read_info(png, info);
  header->width = png_get_image_width(png, info);
  header->height = png_get_image_height(png, info);
  header->bits = png_get_bit_depth(png, info);
  header->colours = png_get_color_type(png, info);
  header->has_alpha =
      (header->colours & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(png, info, PNG_INFO_tRNS) != 0;
  int intent = 0;
  header->is_srgb = png_get_sRGB(png, info, &intent) != 0;
  if (png_get_gAMA(png, info, &header->gamma) == 0) header->gamma = 0;
  png_colorp palette = nullptr;
  int size = 0;
  if (png_get_PLTE(png, info, &palette, &size) != 0 && header->colours == PNG_COLOR_TYPE_PALETTE)
    header->palette_size = size;
  if (raw) {
    png_set_packing(png);
    return true;
  }
  png_set_expand_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xFFFF, PNG_FILLER_AFTER);
  return true;
}

} // namespace

SourceImage read_png_source(const std::string& bytes, const TakesMemory& take) {
  SourceImage image;
  SourceHeader header;
  const auto read = [&](bool raw) {
    Reader reader;
    if (!reader.info) throw std::bad_alloc();
    ByteSource from{&bytes};
    if (!read_source_header(reader.png, reader.info, &from, raw, &header)) fail(reader.message);
    check_size(header.width, header.height);
    check_plausible(reader.png, reader.info, bytes.size());
    const std::size_t pixels = std::size_t{header.width} * header.height;
    take(raw ? pixels : pixels * 16); // the file's bytes and the picture's
    std::vector<png_bytep> rows(header.height);
    std::vector<png_byte> wide; // big-endian, as the file
    if (raw) {
      image.index.resize(pixels);
      for (std::size_t y = 0; y < rows.size(); ++y)
        rows[y] = image.index.data() + y * header.width;
    } else {
      wide.resize(pixels * 8);
      for (std::size_t y = 0; y < rows.size(); ++y)
        rows[y] = wide.data() + y * header.width * 8;
    }
    if (!read_pixels(reader.png, reader.info, rows.data())) fail(reader.message);
    if (raw) return;
    image.rgba.resize(pixels * 4);
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
      image.rgba[i] = static_cast<std::uint16_t>(wide[2 * i] << 8 | wide[2 * i + 1]);
  };
  read(false);
  if (header.palette_size > 0) read(true);
  image.format = SourceFormat::png;
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  image.bits = std::max(header.bits, 8);
  image.is_grey = (header.colours & PNG_COLOR_MASK_COLOR) == 0;
  image.has_alpha = header.has_alpha;
  image.palette_size = header.palette_size;
  image.is_srgb = header.is_srgb;
  if (header.gamma > 0) image.gamma = 1 / header.gamma;
  return image;
}

} // namespace celltrace::image
