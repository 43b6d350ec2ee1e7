#include "image/rows.hpp"

#include "celltrace/error.hpp"

#include <cerrno>
#include <cmath>
#include <limits>
#include <string>
#include <system_error>

namespace celltrace::image {

namespace {

/// Number of rows that are converted at a time.
constexpr int kBatch = 16;

/// Replaces encoded colours by their luminance.
template <class Channel>
void make_grey(const Channel* rgba, std::size_t pixels, Channel* out, const FileGamma& gamma) {
  constexpr double kMost = std::numeric_limits<Channel>::max();
  const Encoding encoding(1.0, gamma);
  for (std::size_t i = 0; i < 4 * pixels; i += 4) {
    float light[4] = {0, 0, 0, 1};
    for (std::size_t channel = 0; channel < 3; ++channel)
      light[channel] = static_cast<float>(decoded(rgba[i + channel] / kMost, gamma));
    encoding.encode(light, 1, out + i, Alpha::left_out, true);
    out[i + 3] = rgba[i + 3];
  }
}

[[noreturn]] void refuse_encoded() {
  throw InputError("OpenEXR and Radiance files are for colours as numbers");
}

} // namespace

void CountedRows::count(int rows) {
  if (rows < 0 || rows > format_.height - rows_) throw InputError("a picture gets more rows than it has");
  rows_ += rows;
}

void CountedRows::finish() {
  if (rows_ != format_.height)
    throw InputError("a picture has " + std::to_string(rows_) + " of its " + std::to_string(format_.height) +
                     " rows");
  end();
  if (std::fflush(file_) != 0 || std::ferror(file_) != 0)
    throw InputError("cannot be written: " + std::generic_category().message(errno));
}

void EncodedRows::write(const std::uint8_t* rgba, int count) {
  write_encoded(rgba, count);
}
void EncodedRows::write(const std::uint16_t* rgba, int count) {
  write_encoded(rgba, count);
}
void EncodedRows::write(const float* rgba, int count, const FirstHitRows&) {
  if (format().bits == 8)
    write_colours<std::uint8_t>(rgba, count);
  else
    write_colours<std::uint16_t>(rgba, count);
}

template <class Channel> void EncodedRows::write_encoded(const Channel* rgba, int count) {
  if (format().bits != std::numeric_limits<Channel>::digits)
    throw InputError("a file of " + std::to_string(format().bits) + " bits a channel gets rows of " +
                     std::to_string(std::numeric_limits<Channel>::digits));
  CountedRows::count(count);
  if (!is_grey()) return put(rgba, count);
  std::vector<Channel> grey(4 * width());
  for (int row = 0; row < count; ++row, rgba += 4 * width()) {
    make_grey(rgba, width(), grey.data(), format().gamma);
    put(grey.data(), 1);
  }
}

template <class Channel> void EncodedRows::write_colours(const float* rgba, int count) {
  CountedRows::count(count);
  std::vector<Channel> encoded(4 * width() * static_cast<std::size_t>(std::min(count, kBatch)));
  for (int row = 0; row < count; row += kBatch) {
    const int rows = std::min(kBatch, count - row);
    const std::size_t pixels = width() * static_cast<std::size_t>(rows);
    encoding_.encode(rgba, pixels, encoded.data(), has_alpha() ? Alpha::kept : Alpha::left_out, is_grey());
    put(encoded.data(), rows);
    rgba += 4 * pixels;
  }
}

void FloatRows::write(const std::uint8_t*, int) {
  refuse_encoded();
}
void FloatRows::write(const std::uint16_t*, int) {
  refuse_encoded();
}
void FloatRows::write(const float* rgba, int count, const FirstHitRows& hits) {
  CountedRows::count(count);
  const std::size_t pixels = width() * static_cast<std::size_t>(count);
  if (format().colour_gamma != 1.0) {
    linear_.assign(rgba, rgba + 4 * pixels);
    make_linear(linear_.data(), pixels, format().colour_gamma);
    rgba = linear_.data();
  }
  put(rgba, count, hits);
}

} // namespace celltrace::image
