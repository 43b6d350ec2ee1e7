// Writes PNG, after the specification (ISO/IEC 15948). libpng would compress by zlib, which takes three times
// as long as libdeflate for larger files; the rest of a file is a header, checksums and differences of rows.
// libdeflate needs all of a picture at once: larger pictures are compressed by zlib.
#include "image/format_table.hpp"
#include "image/formats.hpp"
#include "image/rows.hpp"

#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include <libdeflate.h>
#include <zlib.h>

namespace celltrace::image {

namespace {

/// Compression level: 2 to 4 are equally fast on rendered pictures; lower levels are slower and compress
/// less.
constexpr int kLevel = 4;
constexpr int kStreamLevel = 4; ///< level of zlib that gives files of the same size
/// Most bytes of pixels that are compressed at once.
constexpr std::uint64_t kMostAtOnce = 64u << 20;

constexpr std::uint8_t kFilterUp = 2;
constexpr std::uint8_t kColourTypes[] = {0, 4, 2, 6}; // by channels: grey, grey and alpha, RGB, RGBA

using Bytes = std::unique_ptr<std::uint8_t[]>;

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

void put_big_endian(std::uint8_t* target, std::uint32_t value) {
  for (int i = 0; i < 4; ++i)
    target[i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

void write_chunk(std::FILE* file, const char (&type)[5], const std::uint8_t* data, std::size_t count) {
  std::uint8_t front[8], checksum[4];
  put_big_endian(front, static_cast<std::uint32_t>(count));
  std::memcpy(front + 4, type, 4);
  std::uint32_t crc = libdeflate_crc32(0, front + 4, 4);
  if (count > 0) crc = libdeflate_crc32(crc, data, count);
  put_big_endian(checksum, crc);
  write_bytes(file, front, sizeof front);
  if (count > 0) write_bytes(file, data, count);
  write_bytes(file, checksum, sizeof checksum);
}

void write_header(std::FILE* file, const RowFormat& format) {
  constexpr std::uint8_t kSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  write_bytes(file, kSignature, sizeof kSignature);
  std::uint8_t header[13] = {}; // deflate, the five filters, not interlaced
  put_big_endian(header, static_cast<std::uint32_t>(format.width));
  put_big_endian(header + 4, static_cast<std::uint32_t>(format.height));
  header[8] = static_cast<std::uint8_t>(format.bits);
  header[9] = kColourTypes[format.channels - 1];
  write_chunk(file, "IHDR", header, sizeof header);
  if (!format.gamma.power) return; // readers take a PNG for sRGB
  std::uint8_t gamma[4];
  put_big_endian(gamma, static_cast<std::uint32_t>(std::lround(100000 / *format.gamma.power)));
  write_chunk(file, "gAMA", gamma, sizeof gamma);
}

/// Writes the differences between a row and the one above, pixel by pixel: filter type Up.
template <int channels, class Channel>
void filter_row(const Channel* row, const Channel* above, std::uint8_t* target, std::size_t width) {
  constexpr std::size_t kBytes = sizeof(Channel);
  for (std::size_t x = 0; x < width; ++x)
    for (std::size_t channel = 0; channel < channels; ++channel) {
      const std::size_t from = 4 * x + (channels == 2 ? 3 * channel : channel);
      const Channel value = row[from], before = above[from];
      std::uint8_t* const bytes = target + kBytes * (channels * x + channel);
      if constexpr (kBytes == 2) bytes[0] = static_cast<std::uint8_t>((value >> 8) - (before >> 8));
      bytes[kBytes - 1] = static_cast<std::uint8_t>(value - before);
    }
}

template <class Channel>
void filter_row(int channels, const Channel* row, const Channel* above, std::uint8_t* target,
                std::size_t width) {
  constexpr void (*kByChannels[])(const Channel*, const Channel*, std::uint8_t*, std::size_t) = {
      filter_row<1, Channel>, filter_row<2, Channel>, filter_row<3, Channel>, filter_row<4, Channel>};
  kByChannels[channels - 1](row, above, target, width);
}

/// Compresses filtered rows.
class Compressor {
public:
  virtual ~Compressor() = default;
  /// Returns the place for `count` more bytes.
  virtual std::uint8_t* next(std::size_t count) = 0;
  /// Compresses the bytes that the caller has written to the place of next().
  virtual void take(std::FILE* file) = 0;
  virtual void finish(std::FILE* file) = 0;
};

/// Keeps all rows, and compresses them at the end.
class WholeCompressor : public Compressor {
public:
  explicit WholeCompressor(std::size_t count)
      : pixels_(std::make_unique_for_overwrite<std::uint8_t[]>(count)) {}

  std::uint8_t* next(std::size_t count) override {
    used_ += count;
    return pixels_.get() + used_ - count;
  }
  void take(std::FILE*) override {}
  void finish(std::FILE* file) override {
    const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
        libdeflate_alloc_compressor(kLevel));
    if (!compressor) throw std::bad_alloc();
    const std::size_t most = libdeflate_zlib_compress_bound(compressor.get(), used_);
    const Bytes compressed = std::make_unique_for_overwrite<std::uint8_t[]>(most);
    const std::size_t size =
        libdeflate_zlib_compress(compressor.get(), pixels_.get(), used_, compressed.get(), most);
    write_chunk(file, "IDAT", compressed.get(), size);
  }

private:
  Bytes pixels_;
  std::size_t used_ = 0;
};

/// Compresses each row when it comes.
class StreamCompressor : public Compressor {
public:
  StreamCompressor() : out_(1u << 20) {
    if (deflateInit2(&stream_, kStreamLevel, Z_DEFLATED, MAX_WBITS, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY) !=
        Z_OK)
      throw std::bad_alloc();
    begin_chunk();
  }
  StreamCompressor(const StreamCompressor&) = delete;
  StreamCompressor& operator=(const StreamCompressor&) = delete;
  ~StreamCompressor() override { deflateEnd(&stream_); }

  std::uint8_t* next(std::size_t count) override {
    row_.resize(count);
    return row_.data();
  }
  void take(std::FILE* file) override {
    stream_.next_in = row_.data();
    stream_.avail_in = static_cast<uInt>(row_.size());
    while (stream_.avail_in > 0) {
      deflate(&stream_, Z_NO_FLUSH);
      if (stream_.avail_out == 0) end_chunk(file);
    }
  }
  void finish(std::FILE* file) override {
    while (deflate(&stream_, Z_FINISH) != Z_STREAM_END)
      end_chunk(file);
    end_chunk(file);
  }

private:
  void begin_chunk() {
    stream_.next_out = out_.data();
    stream_.avail_out = static_cast<uInt>(out_.size());
  }
  void end_chunk(std::FILE* file) {
    const std::size_t count = out_.size() - stream_.avail_out;
    if (count > 0) write_chunk(file, "IDAT", out_.data(), count);
    begin_chunk();
  }

  z_stream stream_ = {};
  std::vector<std::uint8_t> row_, out_;
};

class PngRows : public EncodedRows {
public:
  PngRows(std::FILE* file, const RowFormat& format)
      : EncodedRows(file, format),
        row_bytes_(static_cast<std::size_t>(format.channels * format.bits / 8) * width()) {
    const std::uint64_t all = (1 + row_bytes_) * static_cast<std::uint64_t>(format.height);
    if (all <= kMostAtOnce)
      compressor_ = std::make_unique<WholeCompressor>(static_cast<std::size_t>(all));
    else
      compressor_ = std::make_unique<StreamCompressor>();
    above8_.resize(format.bits == 8 ? 4 * width() : 0);
    above16_.resize(format.bits == 16 ? 4 * width() : 0);
    write_header(file, format);
  }

private:
  void put(const std::uint8_t* rgba, int count) override { filter(rgba, count, above8_); }
  void put(const std::uint16_t* rgba, int count) override { filter(rgba, count, above16_); }
  /// Filters rows. `last` is the row before them, and becomes their last row.
  template <class Channel> void filter(const Channel* rgba, int count, std::vector<Channel>& last) {
    const Channel* above = last.data();
    for (int row = 0; row < count; ++row, rgba += 4 * width()) {
      std::uint8_t* const target = compressor_->next(1 + row_bytes_);
      *target = kFilterUp;
      filter_row(format().channels, rgba, above, target + 1, width());
      compressor_->take(file());
      above = rgba;
    }
    if (count > 0) last.assign(above, above + 4 * width());
  }
  void end() override {
    compressor_->finish(file());
    write_chunk(file(), "IEND", nullptr, 0);
  }

  std::size_t row_bytes_;
  std::unique_ptr<Compressor> compressor_;
  std::vector<std::uint8_t> above8_; ///< empty if rows have 16 bits
  std::vector<std::uint16_t> above16_;
};

} // namespace

std::unique_ptr<RowWriter> open_png(std::FILE* file, const RowFormat& format) {
  return std::make_unique<PngRows>(file, format);
}

} // namespace celltrace::image
