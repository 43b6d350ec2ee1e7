#include "image/format_table.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

namespace celltrace::image {

namespace {

constexpr std::int64_t kMostPixels = 1 << 28; // pixels of a side: a row has at most 2^31 bytes
constexpr std::uint64_t kAnySize = std::numeric_limits<std::int64_t>::max();
constexpr std::uint64_t k32Bits = std::numeric_limits<std::uint32_t>::max();

constexpr bool kGrey = true, kAlpha = true;
constexpr FormatLimits kLarge = {kMostPixels, kAnySize};

/// The formats, in the order of ImageFormat.
const std::array<FormatRow, 8>& rows() {
  using enum Pixels;
  using F = ImageFormat;
  static const std::array<FormatRow, 8> kRows = {{
      {F::png, "a PNG", {"png"}, {encoded, {8, 16}, kGrey, kAlpha}, kLarge, open_png},
      {F::ppm, "a PPM", {"ppm", "pnm"}, {encoded, {8, 16}, kGrey, !kAlpha}, kLarge, open_ppm},
      {F::exr,
       "an OpenEXR file",
       {"exr"},
       {numbers, {16, 32}, !kGrey, kAlpha},
       kLarge,
       open_exr,
       kHasExr ? nullptr : "OpenEXR"},
      {F::hdr, "a Radiance file", {"hdr"}, {numbers, {8}, !kGrey, !kAlpha}, kLarge, open_hdr},
      {F::dds,
       "a DirectDraw surface",
       {"dds"},
       {blocks, {8}, !kGrey, !kAlpha},
       {kMaxImageSide, k32Bits},
       nullptr},
      {F::tga, "a TGA", {"tga"}, {encoded, {8}, kGrey, kAlpha}, {65535, k32Bits}, open_tga},
      {F::bmp, "a BMP", {"bmp"}, {encoded, {8}, !kGrey, kAlpha}, {kMostPixels, k32Bits}, open_bmp},
      {F::jpeg,
       "a JPEG",
       {"jpg", "jpeg"},
       {encoded, {8}, kGrey, !kAlpha},
       {65500, kAnySize},
       open_jpeg,
       kHasJpeg ? nullptr : "libjpeg"},
  }};
  return kRows;
}

std::string size_text(const RowFormat& format) {
  return std::to_string(format.width) + "x" + std::to_string(format.height);
}

void check(const FormatRow& row, const RowFormat& format) {
  check_is_there(row);
  const std::string name = row.name;
  if (row.open == nullptr) throw InputError(name + " is for blocks of pixels");
  if (format.width < 1 || format.height < 1)
    throw InputError("a picture of " + size_text(format) + " pixels is empty");
  if (std::max(format.width, format.height) > row.limits.side)
    throw InputError(name + " has at most " + std::to_string(row.limits.side) +
                     " pixels a side, and the picture " + size_text(format));
  if (format.channels < 1 || format.channels > 4)
    throw InputError("a picture has 1 to 4 channels, not " + std::to_string(format.channels));
  if (format.channels < 3 && !row.holds.grey) throw InputError(name + " has no grey pixels");
  if (std::find(row.holds.bits.begin(), row.holds.bits.end(), format.bits) == row.holds.bits.end())
    throw InputError(name + " has no channels of " + std::to_string(format.bits) + " bits");
  if (format.first_hits && row.format != ImageFormat::exr)
    throw InputError(name + " has no channels of what is seen first");
  // The product fits 64 bits: two sides of 31 bits, and at most 8 bytes a channel.
  const auto pixels = static_cast<std::uint64_t>(format.width) * static_cast<std::uint64_t>(format.height);
  constexpr std::uint64_t kHeader = 1024; // more than any format needs besides pixels
  if (pixels > (row.limits.bytes - kHeader) / static_cast<std::uint64_t>(format.channels))
    throw InputError("a picture of " + size_text(format) + " pixels is too large for " + name);
}

} // namespace

const FormatRow& row_of(ImageFormat format) {
  return rows().at(static_cast<std::size_t>(format));
}

const FormatRow* find_format(const std::string& extension) {
  std::string lower;
  for (const char c : extension)
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (lower.empty() || lower[0] != '.') return nullptr;
  for (const FormatRow& row : rows())
    for (const std::string_view each : row.extensions)
      if (lower.compare(1, std::string::npos, each) == 0) return &row;
  return nullptr;
}

std::string extensions() {
  std::string list;
  for (const FormatRow& row : rows()) {
    if (&row != &rows().front()) list += &row == &rows().back() ? " and " : ", ";
    list += '.';
    list += row.extensions[0];
  }
  return list;
}

void check_is_there(const FormatRow& row) {
  if (row.absent != nullptr)
    throw InputError(std::string("this build cannot write ") + row.absent +
                     " files: its library was not there when it was configured");
}

std::unique_ptr<RowWriter> open_rows(std::FILE* file, ImageFormat format, const RowFormat& rows) {
  const FormatRow& row = row_of(format);
  check(row, rows);
  RowFormat stored = rows;
  if (!row.holds.alpha) stored.channels = rows.channels < 3 ? 1 : 3;
  if (!rows.colour_gamma) stored.gamma = {}; // values are written unchanged, which readers take for sRGB
  return row.open(file, stored);
}

} // namespace celltrace::image
