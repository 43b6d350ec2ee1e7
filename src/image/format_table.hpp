// The picture formats as a table: their names, what each can hold, and the functions that write it.
#pragma once

#include "image/row_writer.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::image {

/// The kinds of pictures.
enum class Pixels {
  encoded, ///< Image and DeepImage
  numbers, ///< ColourImage
  blocks   ///< BlockImage
};

struct FormatChannels {
  Pixels pixels;
  std::vector<int> bits; ///< bits a channel, the usual number first
  bool grey, alpha;      ///< true if the format can have this
};

struct FormatLimits {
  std::int64_t side;   ///< largest width and height, in pixels
  std::uint64_t bytes; ///< largest size of a file
};

/// A picture format.
struct FormatRow {
  ImageFormat format;
  const char* name;                         ///< name for people, with its article
  std::vector<std::string_view> extensions; ///< lower case, without their dot; POV-Ray's first
  FormatChannels holds;
  FormatLimits limits;
  /// Opens a writer of rows; null if the format is not written by rows.
  std::unique_ptr<RowWriter> (*open)(std::FILE*, const RowFormat&);
  const char* absent = nullptr; ///< library that this build lacks for the format; null if none
};

const FormatRow& row_of(ImageFormat format);
/// Returns the format of an extension in upper or lower case, with its dot; null for an unknown extension.
const FormatRow* find_format(const std::string& extension);
/// Returns one extension of each format: ".png, .ppm and .dds".
std::string extensions();
/// Throws InputError if the build cannot write the format.
void check_is_there(const FormatRow& row);

std::unique_ptr<RowWriter> open_png(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_ppm(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_exr(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_hdr(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_tga(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_bmp(std::FILE* file, const RowFormat& format);
std::unique_ptr<RowWriter> open_jpeg(std::FILE* file, const RowFormat& format);
/// True if the build has the libraries of these formats.
extern const bool kHasExr, kHasJpeg;

} // namespace celltrace::image
