// Writes Truevision's TGA, after its "File Format Specification, Version 2.0" (1991): rows from the top, as
// POV-Ray writes them, with the extension area, which defines alpha and the encoding of colours.
#include "image/format_table.hpp"
#include "image/formats.hpp"
#include "image/rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace celltrace::image {

namespace {

constexpr std::uint8_t kTrueColour = 2, kGrey = 3, kRunLengths = 8; // image types
constexpr std::uint8_t kFromTheTop = 0x20;

void put_little_endian(std::uint8_t* target, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i)
    target[i] = static_cast<std::uint8_t>(value >> 8 * i);
}

class TgaRows : public EncodedRows {
public:
  TgaRows(std::FILE* file, const RowFormat& format)
      : EncodedRows(file, format), bytes_(static_cast<std::size_t>(stored_channels())) {
    std::array<std::uint8_t, 18> header = {};
    header[2] =
        static_cast<std::uint8_t>((is_grey() ? kGrey : kTrueColour) + (format.run_lengths ? kRunLengths : 0));
    put_little_endian(&header[12], static_cast<std::uint64_t>(format.width), 2);
    put_little_endian(&header[14], static_cast<std::uint64_t>(format.height), 2);
    header[16] = static_cast<std::uint8_t>(8 * bytes_);
    header[17] = static_cast<std::uint8_t>(kFromTheTop | (has_alpha() ? 8 : 0));
    write_counted(header.data(), header.size());
    row_.resize(bytes_ * width());
  }

private:
  int stored_channels() const { return format().channels; }

  void put(const std::uint8_t* rgba, int count) override {
    for (int y = 0; y < count; ++y) {
      std::uint8_t* target = row_.data();
      for (std::size_t x = 0; x < width(); ++x, rgba += 4) {
        if (!is_grey()) {
          *target++ = rgba[2];
          *target++ = rgba[1];
        }
        *target++ = rgba[0];
        if (has_alpha()) *target++ = rgba[3];
      }
      if (format().run_lengths)
        write_runs();
      else
        write_counted(row_.data(), row_.size());
    }
  }

  bool are_equal(std::size_t x, std::size_t other) const {
    return std::memcmp(&row_[x * bytes_], &row_[other * bytes_], bytes_) == 0;
  }
  /// Writes packets: a count less 1 and as many pixels; or a count less 1 with the highest bit set, and one
  /// pixel.
  void write_runs() {
    constexpr std::size_t kMost = 128;
    packets_.clear();
    for (std::size_t x = 0; x < width();) {
      const std::size_t most = std::min(width(), x + kMost);
      std::size_t end = x + 1;
      while (end < most && are_equal(end, x))
        ++end;
      const bool is_run = end - x > 1;
      if (!is_run) // ends before two equal pixels
        while (end < most && (end + 1 >= width() || !are_equal(end, end + 1)))
          ++end;
      packets_.push_back(static_cast<std::uint8_t>(end - x - 1 + (is_run ? 128 : 0)));
      const auto first = row_.begin() + static_cast<std::ptrdiff_t>(x * bytes_);
      packets_.insert(packets_.end(), first,
                      first + static_cast<std::ptrdiff_t>((is_run ? 1 : end - x) * bytes_));
      x = end;
    }
    write_counted(packets_.data(), packets_.size());
  }

  void end() override {
    constexpr std::size_t kExtensionBytes = 495;
    constexpr std::uint8_t kNoAlpha = 0, kStraightAlpha = 3;
    std::array<std::uint8_t, kExtensionBytes> extension = {};
    put_little_endian(extension.data(), kExtensionBytes, 2);
    const std::string software = "celltrace";
    std::copy(software.begin(), software.end(), extension.begin() + 426);
    // Gamma is a ratio of two whole numbers; sRGB is about 2.2.
    put_little_endian(&extension[478],
                      static_cast<std::uint64_t>(std::lround(1000 * format().gamma.power.value_or(2.2))), 2);
    put_little_endian(&extension[480], 1000, 2);
    extension[494] = has_alpha() ? kStraightAlpha : kNoAlpha;
    std::array<std::uint8_t, 26> footer = {};
    put_little_endian(footer.data(), written_, 4);
    std::memcpy(&footer[8], "TRUEVISION-XFILE.", 18);
    write_counted(extension.data(), extension.size());
    write_counted(footer.data(), footer.size());
  }

  void write_counted(const std::uint8_t* bytes, std::size_t count) {
    write_bytes(file(), bytes, count);
    written_ += count;
  }

  std::size_t bytes_; ///< bytes of a pixel
  std::vector<std::uint8_t> row_, packets_;
  std::uint64_t written_ = 0; ///< bytes
};

} // namespace

std::unique_ptr<RowWriter> open_tga(std::FILE* file, const RowFormat& format) {
  return std::make_unique<TgaRows>(file, format);
}

} // namespace celltrace::image
