// The picture formats as a table: what each is called and can hold, and who writes it.
#pragma once

#include "image/row_writer.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::image {

/// What pictures are made of.
enum class Pixels {
  encoded, ///< Image and DeepImage
  numbers, ///< ColourImage
  blocks   ///< BlockImage
};

/// A picture format.
struct FormatRow {
  ImageFormat format;
  const char* name;                         ///< for people, with its article
  std::vector<std::string_view> extensions; ///< lower case, without their dot; POV-Ray's first
  Pixels pixels;
  std::vector<int> bits; ///< a channel, the usual number first
  bool grey, alpha;      ///< whether it has these
  std::int64_t longest_side;
  std::uint64_t most_bytes;                                         ///< of a file
  std::unique_ptr<RowWriter> (*open)(std::FILE*, const RowFormat&); ///< null: not made of rows
  const char* absent = nullptr; ///< a library that this build lacks for the format; null: it has all
};

const FormatRow& row_of(ImageFormat format);
/// Returns null if no format has this extension, which may be of either case and has a dot.
const FormatRow* find_format(const std::string& extension);
/// Returns the extensions that can be written: ".png, .ppm and .dds".
std::string extensions_of(bool (*is_wanted)(const FormatRow&));
/// Throws InputError if the build cannot write the format.
void check_is_there(const FormatRow& row);

std::unique_ptr<RowWriter> open_png(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_ppm(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_exr(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_hdr(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_tga(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_bmp(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_jpeg(std::FILE* file, const RowFormat& format);
/// Whether the build has the libraries of these.
extern const bool kHasExr, kHasJpeg;

} // namespace celltrace::image
