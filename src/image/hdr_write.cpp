// Writes Radiance's pictures (RGBE), after Ward, "Real Pixels" (Graphics Gems II, 1991): three mantissas of 8
// bits and one exponent a pixel, in run-length encoded rows.
#include "image/format_table.hpp"
#include "image/formats.hpp"
#include "image/rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace celltrace::image {

namespace {

using Pixel = std::array<std::uint8_t, 4>;

/// Encodes a pixel, so that the greatest channel has 8 significant bits.
Pixel encoded(const float* rgb) {
  double channel[3], greatest = 0;
  for (int i = 0; i < 3; ++i) {
    const auto value = static_cast<double>(rgb[i]);
    channel[i] = value > 0 ? std::min(value, 1e38) : 0; // NaN becomes 0, too
    greatest = std::max(greatest, channel[i]);
  }
  int exponent = 0;
  std::frexp(greatest, &exponent);
  // Rounding may carry the greatest channel into the next power of two.
  if (std::lround(std::ldexp(greatest, 8 - exponent)) > 255) ++exponent;
  if (greatest < 1e-32 || exponent < -127) return {0, 0, 0, 0};
  Pixel pixel;
  for (std::size_t i = 0; i < 3; ++i)
    pixel[i] = static_cast<std::uint8_t>(std::lround(std::ldexp(channel[i], 8 - exponent)));
  pixel[3] = static_cast<std::uint8_t>(exponent + 128);
  return pixel;
}

/// Appends one channel of a row: for a run, 128 plus its length and a byte; else a count and as
/// many bytes.
void append_runs(const std::vector<Pixel>& row, std::size_t channel, std::string& out) {
  constexpr std::size_t kLongestRun = 127, kMostBytes = 128, kWorthwhile = 4;
  const auto length_of_run = [&](std::size_t at) {
    std::size_t end = at + 1;
    while (end < row.size() && end - at < kLongestRun && row[end][channel] == row[at][channel])
      ++end;
    return end - at;
  };
  for (std::size_t at = 0; at < row.size();) {
    const std::size_t run = length_of_run(at);
    if (run >= kWorthwhile) {
      out += static_cast<char>(128 + run);
      out += static_cast<char>(row[at][channel]);
      at += run;
      continue;
    }
    std::size_t end = at;
    while (end < row.size() && end - at < kMostBytes && length_of_run(end) < kWorthwhile)
      ++end;
    out += static_cast<char>(end - at);
    for (; at < end; ++at)
      out += static_cast<char>(row[at][channel]);
  }
}

class HdrRows : public FloatRows {
public:
  HdrRows(std::FILE* file, const RowFormat& format) : FloatRows(file, format), row_(width()) {
    const std::string header = "#?RADIANCE\nSOFTWARE=celltrace\nFORMAT=32-bit_rle_rgbe\n\n-Y " +
                               std::to_string(format.height) + " +X " + std::to_string(format.width) + "\n";
    write_bytes(file, header.data(), header.size());
  }

private:
  void put(const float* rgba, int count, const FirstHitRows&) override {
    constexpr std::size_t kLeastWidth = 8, kGreatestWidth = 32767; // of rows that may be encoded
    for (int y = 0; y < count; ++y) {
      for (Pixel& pixel : row_) {
        pixel = encoded(rgba);
        rgba += 4;
      }
      std::string out;
      if (width() >= kLeastWidth && width() <= kGreatestWidth) {
        out = {2, 2, static_cast<char>(width() >> 8), static_cast<char>(width() & 0xFF)};
        for (std::size_t channel = 0; channel < 4; ++channel)
          append_runs(row_, channel, out);
      } else {
        for (const Pixel& pixel : row_)
          out.append(pixel.begin(), pixel.end());
      }
      write_bytes(file(), out.data(), out.size());
    }
  }

  std::vector<Pixel> row_;
};

} // namespace

std::unique_ptr<RowWriter> open_hdr(std::FILE* file, const RowFormat& format) {
  return std::make_unique<HdrRows>(file, format);
}

} // namespace celltrace::image
