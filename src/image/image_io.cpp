// Chooses the format and names the file in errors.
#include "image/file.hpp"
#include "image/formats.hpp"
#include "image/limits.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <system_error>

namespace celltrace {
namespace fs = std::filesystem;

namespace {

ImageFormat format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".png") return ImageFormat::png;
  if (extension == ".ppm") return ImageFormat::ppm;
  if (extension == ".hdr") return ImageFormat::hdr;
  if (extension == ".exr") {
    image::check_has_exr();
    return ImageFormat::exr;
  }
  if (extension == ".dds") return ImageFormat::dds;
  throw InputError("the picture formats that can be written are .png, .ppm, .exr, .hdr and .dds");
}

template <class Channel>
void write_encoded(std::FILE* file, ImageFormat format, const BasicImage<Channel>& image) {
  image::check_image(image);
  if (format == ImageFormat::png)
    image::write_png(file, image);
  else if (format == ImageFormat::ppm)
    image::write_ppm(file, image);
  else
    throw InputError(format == ImageFormat::dds ? "a DirectDraw surface is for blocks of pixels"
                                                : "OpenEXR and Radiance files are for colours as numbers");
}

void write_numbers(std::FILE* file, ImageFormat format, const ColourImage& colours, const ExrOptions& exr) {
  image::check_image(colours);
  if (!holds_numbers(format)) throw InputError("colours as numbers are for OpenEXR and Radiance files");
  const ColourImage linear = image::to_linear(colours);
  if (format == ImageFormat::hdr)
    image::write_hdr(file, linear);
  else
    image::write_exr(file, linear, exr);
}

void write_blocks(std::FILE* file, ImageFormat format, const BlockImage& blocks) {
  image::check_blocks(blocks);
  if (format != ImageFormat::dds) throw InputError("blocks of pixels are for DirectDraw surfaces");
  image::write_dds(file, blocks);
}

/// What has no name is complete when it has left the program.
void flush(std::FILE* file) {
  if (std::fflush(file) != 0 || std::ferror(file) != 0)
    throw InputError("cannot be written: " + std::generic_category().message(errno));
}

Image load(std::FILE* file, std::uintmax_t file_bytes) {
  unsigned char magic[8] = {};
  const std::size_t have = std::fread(magic, 1, sizeof magic, file);
  std::rewind(file);
  if (have == 8 && std::memcmp(magic, "\x89PNG\r\n\x1a\n", 8) == 0) return image::read_png(file, file_bytes);
  if (have >= 2 && std::memcmp(magic, "P6", 2) == 0) return image::read_ppm(file, file_bytes);
  throw InputError(have == 0 ? "is empty" : "is neither a PNG nor a binary PPM (P6)");
}

/// What `write` writes to a stream that it is given.
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

/// `write` gets the stream and the format.
template <class Write> void save(const fs::path& path, Write write) {
  naming_the_file(path, [&] {
    const ImageFormat format = format_of(path);
    image::OutputFile file(path);
    write(file.get(), format);
    file.commit();
  });
}

} // namespace

ImageFormat image_format_of(const fs::path& path) {
  return naming_the_file(path, [&] { return format_of(path); });
}

void save_image(const fs::path& path, const Image& image) {
  save(path, [&](std::FILE* file, ImageFormat format) { write_encoded(file, format, image); });
}
void save_image(const fs::path& path, const DeepImage& image) {
  save(path, [&](std::FILE* file, ImageFormat format) { write_encoded(file, format, image); });
}
void save_image(const fs::path& path, const ColourImage& colours, const ExrOptions& exr) {
  save(path, [&](std::FILE* file, ImageFormat format) { write_numbers(file, format, colours, exr); });
}

void save_image(const fs::path& path, const BlockImage& blocks) {
  save(path, [&](std::FILE* file, ImageFormat format) { write_blocks(file, format, blocks); });
}

void write_image(std::FILE* file, ImageFormat format, const BlockImage& blocks) {
  write_blocks(file, format, blocks);
  flush(file);
}
void write_image(std::FILE* file, ImageFormat format, const Image& image) {
  write_encoded(file, format, image);
  flush(file);
}
void write_image(std::FILE* file, ImageFormat format, const DeepImage& image) {
  write_encoded(file, format, image);
  flush(file);
}
void write_image(std::FILE* file, ImageFormat format, const ColourImage& colours, const ExrOptions& exr) {
  write_numbers(file, format, colours, exr);
  flush(file);
}

void check_image_path(const fs::path& path) {
  naming_the_file(path, [&] {
    format_of(path);
    std::error_code error;
    if (fs::is_directory(path, error)) throw InputError("is a folder");
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error)) throw InputError("there is no folder " + folder.string());
  });
}

std::vector<std::uint8_t> encode_image(const Image& image, ImageFormat format) {
  return written_by([&](std::FILE* stream) { write_encoded(stream, format, image); });
}
std::vector<std::uint8_t> encode_image(const DeepImage& image, ImageFormat format) {
  return written_by([&](std::FILE* stream) { write_encoded(stream, format, image); });
}
std::vector<std::uint8_t> encode_image(const ColourImage& colours, ImageFormat format,
                                       const ExrOptions& exr) {
  return written_by([&](std::FILE* stream) { write_numbers(stream, format, colours, exr); });
}
std::vector<std::uint8_t> encode_image(const BlockImage& blocks, ImageFormat format) {
  return written_by([&](std::FILE* stream) { write_blocks(stream, format, blocks); });
}

Image decode_image(const std::uint8_t* bytes, std::size_t count) {
  return naming_the_file("picture in memory", [&] {
    if (count == 0) throw InputError("is empty");
    // Only ever read, which the interface cannot say.
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
