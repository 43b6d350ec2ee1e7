// Picture files that are written from the top row to the last one, so that a picture need never be in memory
// whole.
#pragma once

#include "celltrace/image.hpp"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>

namespace celltrace::image {

/// The format of the rows that are passed, and of the file.
struct RowFormat {
  std::int64_t width = 0;
  std::int64_t height = 0;
  /// Channels of the file: 1 (grey), 2 (grey and alpha), 3 (red, green, blue), 4 (and alpha). Formats without
  /// alpha leave alpha out.
  int channels = 3;
  /// Bits a channel of the file: 8 or 16; for OpenEXR 16 or 32, which are floats.
  int bits = 8;
  /// The exponent that makes rows of floats linear, as ColourImage::gamma.
  std::optional<double> colour_gamma = 1.0;
  FileGamma gamma;          ///< the encoding of files of 8 and 16 bits
  int jpeg_quality = 85;    ///< 0 to 100
  bool run_lengths = false; ///< true if a TGA is compressed
  bool first_hits = false;  ///< true if an OpenEXR has channels of first hits
};

/// Rows of FirstHits: for each pixel a depth, three numbers of a normal and the number of an object.
struct FirstHitRows {
  const float* depth = nullptr;
  const float* normal = nullptr;
  const std::uint32_t* object = nullptr;
};

/// A picture file that is being written. Rows follow each other from the top, with four channels a pixel
/// (red, green, blue, alpha) whatever the file has. Errors are InputErrors without the file's name. Not
/// thread safe.
class RowWriter {
public:
  virtual ~RowWriter() = default;

  /// Append `count` rows of encoded values, which files of 8 or 16 bits get unchanged. Throw InputError if
  /// the file has another number of bits, or holds floats.
  virtual void write(const std::uint8_t* rgba, int count) = 0;
  virtual void write(const std::uint16_t* rgba, int count) = 0;
  /// Appends `count` rows of colours as in ColourImage, which are encoded unless the file holds
  /// floats. `hits` is for RowFormat::first_hits.
  virtual void write(const float* rgba, int count, const FirstHitRows& hits = {}) = 0;

  /// Writes the rest, after RowFormat::height rows, and flushes the stream.
  virtual void finish() = 0;
};

/// Begins a picture file at the stream's position. `file` must outlive the writer, and need not be seekable.
/// Throws InputError for pictures that the format cannot hold: numbers of channels or bits, a side or a size
/// that is too large, DirectDraw surfaces (which are not written by rows).
std::unique_ptr<RowWriter> open_rows(std::FILE* file, ImageFormat format, const RowFormat& rows);

} // namespace celltrace::image
