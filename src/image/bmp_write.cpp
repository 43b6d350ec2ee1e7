// Windows' bitmaps out, after Microsoft's "Bitmap Storage": rows from the bottom, as most readers want them
// and as POV-Ray writes them. With alpha the header is version 4, in which it has a mask; without, version 3.
#include "image/format_table.hpp"
#include "image/rows.hpp"
#include "image/seekable.hpp"

#include <vector>

namespace celltrace::image {

namespace {

constexpr std::uint32_t kFileHeader = 14, kInfoHeader = 40, kInfoHeader4 = 108;

class BmpRows : public EncodedRows {
public:
  BmpRows(std::FILE* file, const RowFormat& format)
      : EncodedRows(file, format), bytes_(static_cast<std::size_t>(format.channels)),
        row_bytes_((bytes_ * width() + 3) / 4 * 4),
        first_(kFileHeader + (has_alpha() ? kInfoHeader4 : kInfoHeader)),
        out_(file,
             first_ + static_cast<std::uint64_t>(row_bytes_) * static_cast<std::uint64_t>(format.height)) {
    const std::uint64_t pixels = row_bytes_ * static_cast<std::uint64_t>(format.height);
    if (pixels + first_ > row_of(ImageFormat::bmp).most_bytes)
      throw InputError("the picture is too large for a BMP");
    const std::vector<std::uint8_t> header = make_header(static_cast<std::uint32_t>(pixels));
    out_.write(header.data(), header.size());
  }

private:
  std::vector<std::uint8_t> make_header(std::uint32_t pixels) const {
    std::vector<std::uint8_t> header = {'B', 'M'};
    const auto put = [&](std::uint32_t value, int bytes = 4) {
      for (int i = 0; i < bytes; ++i)
        header.push_back(static_cast<std::uint8_t>(value >> 8 * i));
    };
    constexpr std::uint32_t kNoCompression = 0, kMasks = 3;
    put(first_ + pixels);
    put(0);
    put(first_);
    put(first_ - kFileHeader);
    put(static_cast<std::uint32_t>(format().width));
    put(static_cast<std::uint32_t>(format().height)); // above 0: from the bottom
    put(1, 2);
    put(static_cast<std::uint32_t>(8 * bytes_), 2);
    put(has_alpha() ? kMasks : kNoCompression);
    put(pixels);
    for (int i = 0; i < 4; ++i)
      put(0); // resolution, palette
    if (!has_alpha()) return header;
    for (const std::uint32_t mask : {0x00FF0000u, 0x0000FF00u, 0x000000FFu, 0xFF000000u})
      put(mask);
    constexpr std::uint32_t kSrgb = 0x73524742;
    put(kSrgb);
    header.resize(first_); // end points and gammas, which sRGB has none of
    return header;
  }

  void put(const std::uint8_t* rgba, int count) override {
    if (count == 0) return;
    rows_.assign(row_bytes_ * static_cast<std::size_t>(count), 0);
    for (int y = count - 1; y >= 0; --y, rgba += 4 * width()) {
      std::uint8_t* target = rows_.data() + static_cast<std::size_t>(y) * row_bytes_;
      for (std::size_t x = 0; x < 4 * width(); x += 4) {
        *target++ = rgba[x + 2];
        *target++ = rgba[x + 1];
        *target++ = rgba[x];
        if (has_alpha()) *target++ = rgba[x + 3];
      }
    }
    done_ += count;
    out_.seek(first_ + static_cast<std::uint64_t>(format().height - done_) * row_bytes_);
    out_.write(rows_.data(), rows_.size());
  }
  void end() override { out_.finish(); }

  std::size_t bytes_; ///< a pixel
  std::size_t row_bytes_;
  std::uint32_t first_; ///< where pixels begin
  SeekableFile out_;
  std::vector<std::uint8_t> rows_;
  std::int64_t done_ = 0;
};

} // namespace

std::unique_ptr<RowWriter> open_bmp(std::FILE* file, const RowFormat& format) {
  return std::make_unique<BmpRows>(file, format);
}

} // namespace celltrace::image
