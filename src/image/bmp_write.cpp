// Writes Windows' bitmaps, after Microsoft's "Bitmap Storage": rows from the bottom, as most readers expect,
// and a header of version 3. Alpha is the fourth byte of a pixel, which this header does not define: most
// readers take it for alpha nevertheless, and POV-Ray writes it so.
#include "image/format_table.hpp"
#include "image/rows.hpp"
#include "image/seekable.hpp"

#include <vector>

namespace celltrace::image {

namespace {

constexpr std::uint32_t kFileHeader = 14, kInfoHeader = 40, kFirst = kFileHeader + kInfoHeader;

class BmpRows : public EncodedRows {
public:
  BmpRows(std::FILE* file, const RowFormat& format)
      : EncodedRows(file, format), bytes_(static_cast<std::size_t>(format.channels)),
        row_bytes_((bytes_ * width() + 3) / 4 * 4),
        out_(file,
             kFirst + static_cast<std::uint64_t>(row_bytes_) * static_cast<std::uint64_t>(format.height)) {
    const std::uint64_t pixels = row_bytes_ * static_cast<std::uint64_t>(format.height);
    if (pixels + kFirst > row_of(ImageFormat::bmp).limits.bytes)
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
    constexpr std::uint32_t kNoCompression = 0;
    put(kFirst + pixels);
    put(0);
    put(kFirst);
    put(kInfoHeader);
    put(static_cast<std::uint32_t>(format().width));
    put(static_cast<std::uint32_t>(format().height)); // positive: rows from the bottom
    put(1, 2);
    put(static_cast<std::uint32_t>(8 * bytes_), 2);
    put(kNoCompression);
    put(pixels);
    for (int i = 0; i < 4; ++i)
      put(0); // resolution, palette
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
    out_.seek(kFirst + static_cast<std::uint64_t>(format().height - done_) * row_bytes_);
    out_.write(rows_.data(), rows_.size());
  }
  void end() override { out_.finish(); }

  std::size_t bytes_; ///< bytes of a pixel
  std::size_t row_bytes_;
  SeekableFile out_;
  std::vector<std::uint8_t> rows_;
  std::int64_t done_ = 0;
};

} // namespace

std::unique_ptr<RowWriter> open_bmp(std::FILE* file, const RowFormat& format) {
  return std::make_unique<BmpRows>(file, format);
}

} // namespace celltrace::image
