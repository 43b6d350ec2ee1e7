// Chooses the format and names the file in errors.
#include "image/file.hpp"
#include "image/formats.hpp"
#include "image/limits.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <new>
#include <system_error>

namespace celltrace {
namespace fs = std::filesystem;

namespace {

template <class Channel> using Writer = void (*)(std::FILE*, const BasicImage<Channel>&);

template <class Channel> Writer<Channel> writer_for(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".png") return image::write_png<Channel>;
  if (extension == ".ppm") return image::write_ppm<Channel>;
  throw InputError("the picture formats that can be written are .png and .ppm");
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

template <class Channel>
std::vector<std::uint8_t> encoded(const BasicImage<Channel>& image, ImageFormat format) {
  image::check_image(image);
  return written_by([&](std::FILE* stream) {
    (format == ImageFormat::png ? image::write_png<Channel> : image::write_ppm<Channel>)(stream, image);
  });
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

template <class Channel> void save(const fs::path& path, const BasicImage<Channel>& image) {
  naming_the_file(path, [&] {
    const Writer<Channel> write = writer_for<Channel>(path);
    image::check_image(image);
    image::OutputFile file(path);
    write(file.get(), image);
    file.commit();
  });
}

} // namespace

void save_image(const fs::path& path, const Image& image) {
  save(path, image);
}
void save_image(const fs::path& path, const DeepImage& image) {
  save(path, image);
}

void check_image_path(const fs::path& path) {
  naming_the_file(path, [&] {
    writer_for<std::uint8_t>(path);
    std::error_code error;
    if (fs::is_directory(path, error)) throw InputError("is a folder");
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error)) throw InputError("there is no folder " + folder.string());
  });
}

std::vector<std::uint8_t> encode_image(const Image& image, ImageFormat format) {
  return encoded(image, format);
}
std::vector<std::uint8_t> encode_image(const DeepImage& image, ImageFormat format) {
  return encoded(image, format);
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
