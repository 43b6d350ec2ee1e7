// Reads and writes whole pictures: chooses the format and names the file in errors.
#include "image/file.hpp"
#include "image/format_table.hpp"
#include "image/formats.hpp"
#include "image/limits.hpp"

#include <cerrno>
#include <cstdlib>
#include <limits>
#include <new>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace celltrace {
namespace fs = std::filesystem;

namespace {

/// Returns `known`, or the format of the path's extension if `known` is empty.
const image::FormatRow& format_of(const fs::path& path, std::optional<ImageFormat> known) {
  const image::FormatRow* const row =
      known ? &image::row_of(*known) : image::find_format(path.extension().string());
  if (row == nullptr) throw InputError("the picture formats that can be written are " + image::extensions());
  image::check_is_there(*row);
  return *row;
}

void check_kind(const image::FormatRow& row, image::Pixels given) {
  using image::Pixels;
  if (row.holds.pixels == given || (row.holds.pixels == Pixels::encoded && given == Pixels::numbers)) return;
  const char* const name = row.holds.pixels == Pixels::blocks    ? "blocks of pixels"
                           : row.holds.pixels == Pixels::numbers ? "colours as numbers"
                                                                 : "encoded pixels";
  throw InputError(std::string(row.name) + " is for " + name);
}

template <class Channel> bool is_opaque(const BasicImage<Channel>& image) {
  if constexpr (std::is_floating_point_v<Channel>) {
    for (std::size_t alpha = 3; alpha < image.rgba.size(); alpha += 4)
      if (image.rgba[alpha] != 1) return false;
    return true;
  } else {
    constexpr Channel kOpaque = std::numeric_limits<Channel>::max();
    Channel all = kOpaque;
    for (std::size_t alpha = 3; alpha < image.rgba.size(); alpha += 4)
      all &= image.rgba[alpha];
    return all == kOpaque;
  }
}

template <class Channel>
image::RowFormat rows_of(const BasicImage<Channel>& image, const FileOptions& options, bool has_alpha) {
  image::RowFormat rows;
  rows.width = image.width;
  rows.height = image.height;
  rows.channels = (options.grey ? 1 : 3) + (has_alpha && options.alpha.value_or(!is_opaque(image)) ? 1 : 0);
  rows.bits = 8 * sizeof(Channel);
  rows.gamma = options.gamma;
  rows.jpeg_quality = options.jpeg_quality;
  rows.run_lengths = options.run_lengths;
  return rows;
}

template <class Channel>
void write_encoded(std::FILE* file, ImageFormat format, const BasicImage<Channel>& image,
                   const FileOptions& options) {
  image::check_image(image);
  const image::FormatRow& row = image::row_of(format);
  check_kind(row, image::Pixels::encoded);
  const auto out = image::open_rows(file, format, rows_of(image, options, row.holds.alpha));
  out->write(image.rgba.data(), image.height);
  out->finish();
}

void check_first_hits(const FirstHits& hits, const ColourImage& picture) {
  const std::size_t pixels = picture.rgba.size() / 4;
  if (hits.width != picture.width || hits.height != picture.height || hits.depth.size() != pixels ||
      hits.normal.size() != 3 * pixels || hits.object.size() != pixels)
    throw InputError("what is seen first does not match the size of the picture");
}

void write_floats(std::FILE* file, ImageFormat format, const ColourImage& colours, const ExrOptions& exr,
                  const FileOptions& options) {
  image::check_image(colours);
  const image::FormatRow& row = image::row_of(format);
  check_kind(row, image::Pixels::numbers);
  image::RowFormat rows = rows_of(colours, options, row.holds.alpha);
  rows.colour_gamma = colours.gamma;
  rows.bits = row.holds.pixels == image::Pixels::encoded ? options.bits
              : format == ImageFormat::exr               ? (exr.full_floats ? 32 : 16)
                                                         : row.holds.bits[0];
  image::FirstHitRows hits;
  if (format == ImageFormat::exr && exr.first_hits != nullptr) {
    check_first_hits(*exr.first_hits, colours);
    rows.first_hits = true;
    hits = {exr.first_hits->depth.data(), exr.first_hits->normal.data(), exr.first_hits->object.data()};
  }
  const auto out = image::open_rows(file, format, rows);
  out->write(colours.rgba.data(), colours.height, hits);
  out->finish();
}

void write_blocks(std::FILE* file, ImageFormat format, const BlockImage& blocks) {
  image::check_blocks(blocks);
  if (format != ImageFormat::dds) throw InputError("blocks of pixels are for DirectDraw surfaces");
  image::write_dds(file, blocks);
}

/// Flushes a stream without a name, and throws InputError if a write failed.
void flush(std::FILE* file) {
  if (std::fflush(file) != 0 || std::ferror(file) != 0)
    throw InputError("cannot be written: " + std::generic_category().message(errno));
}

/// A format that can be read, and the bytes with which its files begin.
struct Reader {
  std::string_view magic;
  Image (*read)(std::FILE*, std::uintmax_t);
};
constexpr Reader kReaders[] = {
    {"\x89PNG\r\n\x1a\n", image::read_png},
    {"P6", image::read_ppm},
    {"BM", image::read_bmp},
    {"\xFF\xD8\xFF", image::read_jpeg},
};

Image load(std::FILE* file, std::uintmax_t file_bytes) {
  char bytes[8] = {};
  const std::string_view begin(bytes, std::fread(bytes, 1, sizeof bytes, file));
  std::rewind(file);
  for (const Reader& reader : kReaders)
    if (begin.substr(0, reader.magic.size()) == reader.magic) return reader.read(file, file_bytes);
  if (image::is_tga(file, file_bytes)) return image::read_tga(file, file_bytes);
  throw InputError(begin.empty() ? "is empty" : "is neither a PNG nor a binary PPM (P6), BMP, JPEG or TGA");
}

/// Returns the bytes that `write` writes to a stream.
template <class Write> std::vector<std::uint8_t> written_by(Write write) {
  struct Memory {
    char* bytes = nullptr;
    std::size_t count = 0;
    std::FILE* stream = open_memstream(&bytes, &count);
    Memory() = default;
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
    ~Memory() {
      if (stream) std::fclose(stream);
      std::free(bytes);
    }
  } memory;
  if (!memory.stream) throw OutOfMemory();
  write(memory.stream);
  if (std::fflush(memory.stream) != 0 || std::ferror(memory.stream) != 0) throw OutOfMemory();
  return {memory.bytes, memory.bytes + memory.count};
}

template <class Work> auto naming_the_file(const fs::path& path, Work work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  } catch (const std::bad_alloc&) {
    throw OutOfMemory();
  }
}

/// Saves a picture; `write` gets the stream and the format.
template <class Write> void save(const fs::path& path, std::optional<ImageFormat> known, Write write) {
  naming_the_file(path, [&] {
    const ImageFormat format = format_of(path, known).format;
    image::OutputFile file(path);
    write(file.get(), format);
    file.commit();
  });
}

} // namespace

ImageFormat image_format_of(const fs::path& path) {
  return naming_the_file(path, [&] { return format_of(path, {}).format; });
}

void save_image(const fs::path& path, const Image& image, const FileOptions& options) {
  save(path, options.format,
       [&](std::FILE* file, ImageFormat format) { write_encoded(file, format, image, options); });
}
void save_image(const fs::path& path, const DeepImage& image, const FileOptions& options) {
  save(path, options.format,
       [&](std::FILE* file, ImageFormat format) { write_encoded(file, format, image, options); });
}
void save_image(const fs::path& path, const ColourImage& colours, const ExrOptions& exr,
                const FileOptions& options) {
  save(path, options.format,
       [&](std::FILE* file, ImageFormat format) { write_floats(file, format, colours, exr, options); });
}
void save_image(const fs::path& path, const BlockImage& blocks, const FileOptions& options) {
  save(path, options.format,
       [&](std::FILE* file, ImageFormat format) { write_blocks(file, format, blocks); });
}

void write_image(std::FILE* file, ImageFormat format, const Image& image, const FileOptions& options) {
  write_encoded(file, format, image, options);
}
void write_image(std::FILE* file, ImageFormat format, const DeepImage& image, const FileOptions& options) {
  write_encoded(file, format, image, options);
}
void write_image(std::FILE* file, ImageFormat format, const ColourImage& colours, const ExrOptions& exr,
                 const FileOptions& options) {
  write_floats(file, format, colours, exr, options);
}
void write_image(std::FILE* file, ImageFormat format, const BlockImage& blocks, const FileOptions&) {
  write_blocks(file, format, blocks);
  flush(file);
}

void check_image_path(const fs::path& path, std::optional<ImageFormat> format) {
  naming_the_file(path, [&] {
    format_of(path, format);
    image::check_output(path);
  });
}

std::vector<std::uint8_t> encode_image(const Image& image, ImageFormat format, const FileOptions& options) {
  return written_by([&](std::FILE* stream) { write_encoded(stream, format, image, options); });
}
std::vector<std::uint8_t> encode_image(const DeepImage& image, ImageFormat format,
                                       const FileOptions& options) {
  return written_by([&](std::FILE* stream) { write_encoded(stream, format, image, options); });
}
std::vector<std::uint8_t> encode_image(const ColourImage& colours, ImageFormat format, const ExrOptions& exr,
                                       const FileOptions& options) {
  return written_by([&](std::FILE* stream) { write_floats(stream, format, colours, exr, options); });
}
std::vector<std::uint8_t> encode_image(const BlockImage& blocks, ImageFormat format) {
  return written_by([&](std::FILE* stream) { write_blocks(stream, format, blocks); });
}

Image decode_image(const std::uint8_t* bytes, std::size_t count) {
  return naming_the_file("picture in memory", [&] {
    if (count == 0) throw InputError("is empty");
    // The stream only reads, which the interface cannot express.
    const image::File stream(fmemopen(const_cast<std::uint8_t*>(bytes), count, "rb"));
    if (!stream) throw OutOfMemory();
    return load(stream.get(), count);
  });
}

Image load_image(const fs::path& path) {
  return naming_the_file(path, [&] {
    const image::File file = image::open_for_reading(path);
    return load(file.get(), fs::file_size(path));
  });
}

} // namespace celltrace
