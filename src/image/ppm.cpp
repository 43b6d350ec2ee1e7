// Binary PPM (P6) as netpbm's manual defines it.
#include "image/formats.hpp"
#include "image/limits.hpp"

#include <cctype>
#include <limits>

namespace celltrace::image {

namespace {

int read_byte(std::FILE* file) {
  const int c = std::getc(file);
  if (c == EOF) throw InputError("is truncated");
  return c;
}

/// Skips white space and comments before a number and the one white space character after it.
std::int64_t read_number(std::FILE* file) {
  int c = read_byte(file);
  while (std::isspace(c) || c == '#') {
    if (c == '#')
      while (c != '\n' && c != '\r')
        c = read_byte(file);
    else
      c = read_byte(file);
  }
  std::int64_t value = 0;
  int digits = 0;
  for (; std::isdigit(c); c = read_byte(file)) {
    value = 10 * value + (c - '0');
    if (++digits > 9) throw InputError("has a number in its PPM header that is too large");
  }
  if (digits == 0 || !std::isspace(c)) throw InputError("has a damaged PPM header");
  return value;
}

std::uint8_t to_8_bits(unsigned value, unsigned maximum) {
  if (value > maximum) throw InputError("has a sample over its own maximum");
  return static_cast<std::uint8_t>((value * 255u + maximum / 2) / maximum);
}

} // namespace

Image read_ppm(std::FILE* file, std::uintmax_t file_bytes) {
  std::fseek(file, 2, SEEK_SET);
  const std::int64_t width = read_number(file);
  const std::int64_t height = read_number(file);
  const std::int64_t maximum = read_number(file);
  check_size(width, height);
  if (maximum < 1 || maximum > 65535) throw InputError("has a PPM maximum outside 1..65535");
  const std::size_t sample_bytes = maximum < 256 ? 1 : 2;
  const std::size_t row_bytes = 3 * sample_bytes * static_cast<std::size_t>(width);
  if (row_bytes * static_cast<std::uintmax_t>(height) > file_bytes) throw InputError("is truncated");

  Image image(static_cast<int>(width), static_cast<int>(height));
  std::vector<std::uint8_t> row(row_bytes);
  for (int y = 0; y < image.height; ++y) {
    if (std::fread(row.data(), 1, row_bytes, file) != row_bytes) throw InputError("is truncated");
    const std::uint8_t* sample = row.data();
    for (int x = 0; x < image.width; ++x)
      for (int channel = 0; channel < 3; ++channel, sample += sample_bytes) {
        const unsigned value = sample_bytes == 1 ? sample[0] : 256u * sample[0] + sample[1];
        image.pixel(x, y)[channel] = to_8_bits(value, static_cast<unsigned>(maximum));
      }
  }
  return image;
}

template <class Channel> void write_ppm(std::FILE* file, const BasicImage<Channel>& image) {
  std::fprintf(file, "P6\n%d %d\n%d\n", image.width, image.height, std::numeric_limits<Channel>::max());
  std::vector<std::uint8_t> row(3 * sizeof(Channel) * static_cast<std::size_t>(image.width));
  for (int y = 0; y < image.height; ++y) {
    std::uint8_t* target = row.data();
    for (int x = 0; x < image.width; ++x)
      for (int channel = 0; channel < 3; ++channel) {
        const Channel value = image.pixel(x, y)[channel];
        if constexpr (sizeof(Channel) == 2) *target++ = static_cast<std::uint8_t>(value >> 8);
        *target++ = static_cast<std::uint8_t>(value);
      }
    std::fwrite(row.data(), 1, row.size(), file);
  }
}
template void write_ppm(std::FILE* file, const Image& image);
template void write_ppm(std::FILE* file, const DeepImage& image);

} // namespace celltrace::image
