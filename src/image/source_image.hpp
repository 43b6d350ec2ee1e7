// Pictures that scenes read: with all bits of their files, and with what the files say of their colours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace celltrace::image {

enum class SourceFormat { png, jpeg, tga, bmp, ppm };

struct SourceImage {
  SourceFormat format = SourceFormat::png;
  int width = 0, height = 0;
  std::vector<std::uint16_t> rgba; ///< four a pixel, row by row from the top; 65535 is 1, and opaque
  bool is_grey = false;            ///< the file has one channel, not counting alpha
  bool has_alpha = false;
  int bits = 8;                    ///< of a channel in the file, at least 8
  std::vector<std::uint8_t> index; ///< of each pixel in the palette; empty: there is no palette
  int palette_size = 0;
  std::optional<double> gamma; ///< what the values are to the power of this are linear, by the file's chunk
  bool is_srgb = false;        ///< the file says that its values are encoded by sRGB
};

/// Is called with the bytes that a picture is going to take, and may throw.
using TakesMemory = std::function<void(std::size_t bytes)>;

/// Decodes the bytes of a picture file. Throws InputError, without the file's name, if the picture is damaged,
/// too large or of no format that is read.
SourceImage read_source_image(const std::string& bytes, const TakesMemory& take);

/// Reads a PNG.
SourceImage read_png_source(const std::string& bytes, const TakesMemory& take);

} // namespace celltrace::image
