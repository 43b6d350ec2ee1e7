#include "image/format_table.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

namespace celltrace::image {

namespace {

constexpr std::int64_t kMostPixels = std::numeric_limits<std::int32_t>::max(); // a side, as 32 bits have it
constexpr std::uint64_t kAnySize = std::numeric_limits<std::int64_t>::max();
constexpr std::uint64_t k32Bits = std::numeric_limits<std::uint32_t>::max();

/// In the order of ImageFormat.
const std::array<FormatRow, 8>& rows() {
  static const std::array<FormatRow, 8> kRows = {{
      {ImageFormat::png,
       "a PNG",
       {"png"},
       Pixels::encoded,
       {8, 16},
       true,
       true,
       kMostPixels,
       kAnySize,
       open_png},
      {ImageFormat::ppm,
       "a PPM",
       {"ppm", "pnm"},
       Pixels::encoded,
       {8, 16},
       true,
       false,
       kMostPixels,
       kAnySize,
       open_ppm},
      {ImageFormat::exr,
       "an OpenEXR file",
       {"exr"},
       Pixels::numbers,
       {16, 32},
       false,
       true,
       kMostPixels,
       kAnySize,
       open_exr,
       kHasExr ? nullptr : "OpenEXR"},
      {ImageFormat::hdr,
       "a Radiance file",
       {"hdr"},
       Pixels::numbers,
       {8},
       false,
       false,
       kMostPixels,
       kAnySize,
       open_hdr},
      {ImageFormat::dds,
       "a DirectDraw surface",
       {"dds"},
       Pixels::blocks,
       {8},
       false,
       false,
       kMaxImageSide,
       k32Bits,
       nullptr},
      {ImageFormat::tga, "a TGA", {"tga"}, Pixels::encoded, {8}, true, true, 65535, k32Bits, open_tga},
      {ImageFormat::bmp, "a BMP", {"bmp"}, Pixels::encoded, {8}, false, true, kMostPixels, k32Bits, open_bmp},
      {ImageFormat::jpeg,
       "a JPEG",
       {"jpg", "jpeg"},
       Pixels::encoded,
       {8},
       true,
       false,
       65500,
       kAnySize,
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
  if (std::max(format.width, format.height) > row.longest_side)
    throw InputError(name + " has at most " + std::to_string(row.longest_side) +
                     " pixels a side, and the picture " + size_text(format));
  if (format.channels < 1 || format.channels > 4 || (format.channels < 3 && !row.grey))
    throw InputError(name + " has no grey pixels");
  if (std::find(row.bits.begin(), row.bits.end(), format.bits) == row.bits.end())
    throw InputError(name + " has no channels of " + std::to_string(format.bits) + " bits");
  if (format.first_hits && row.format != ImageFormat::exr)
    throw InputError(name + " has no channels of what is seen first");
  // The product of two sides of 31 bits and 8 bytes a channel at most fits.
  const auto pixels = static_cast<std::uint64_t>(format.width) * static_cast<std::uint64_t>(format.height);
  constexpr std::uint64_t kHeader = 1024; // more than any format has besides pixels
  if (pixels > (row.most_bytes - kHeader) / static_cast<std::uint64_t>(format.channels))
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

std::string extensions_of(bool (*is_wanted)(const FormatRow&)) {
  std::vector<std::string> names;
  for (const FormatRow& row : rows())
    if (is_wanted(row)) names.push_back("." + std::string(row.extensions[0]));
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
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
  if (!row.alpha) stored.channels = rows.channels < 3 ? 1 : 3;
  return row.open(file, stored);
}

} // namespace celltrace::image
