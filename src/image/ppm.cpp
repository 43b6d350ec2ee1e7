// Reads and writes binary PPM (P6), and writes PGM (P5), as netpbm's manual defines them.
#include "image/format_table.hpp"
#include "image/formats.hpp"
#include "image/limits.hpp"
#include "image/rows.hpp"

#include <cctype>
#include <string>
#include <vector>

namespace celltrace::image {

namespace {

int read_byte(std::FILE* file) {
  const int c = std::getc(file);
  if (c == EOF) throw InputError("is truncated");
  return c;
}

/// Reads a number, after white space and comments, and the one white space character behind it.
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

namespace {

class PpmRows : public EncodedRows {
public:
  PpmRows(std::FILE* file, const RowFormat& format) : EncodedRows(file, format) {
    const std::string header = std::string(is_grey() ? "P5" : "P6") + "\n" + std::to_string(format.width) +
                               " " + std::to_string(format.height) + "\n" +
                               (format.bits == 8 ? "255" : "65535") + "\n";
    write_bytes(file, header.data(), header.size());
    row_.resize(static_cast<std::size_t>((is_grey() ? 1 : 3) * format.bits / 8) * width());
  }

private:
  void put(const std::uint8_t* rgba, int count) override { write_rows(rgba, count); }
  void put(const std::uint16_t* rgba, int count) override { write_rows(rgba, count); }
  template <class Channel> void write_rows(const Channel* rgba, int count) {
    const std::size_t channels = is_grey() ? 1 : 3;
    for (int y = 0; y < count; ++y) {
      std::uint8_t* target = row_.data();
      for (std::size_t x = 0; x < width(); ++x, rgba += 4)
        for (std::size_t channel = 0; channel < channels; ++channel) {
          if constexpr (sizeof(Channel) == 2) *target++ = static_cast<std::uint8_t>(rgba[channel] >> 8);
          *target++ = static_cast<std::uint8_t>(rgba[channel]);
        }
      write_bytes(file(), row_.data(), row_.size());
    }
  }

  std::vector<std::uint8_t> row_;
};

} // namespace

std::unique_ptr<RowWriter> open_ppm(std::FILE* file, const RowFormat& format) {
  return std::make_unique<PpmRows>(file, format);
}

} // namespace celltrace::image
