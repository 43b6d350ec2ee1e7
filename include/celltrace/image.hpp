// Pictures in memory: of 8 bits a channel, read from and written to files, and compared with each other; of
// 16, written to files; and colours as numbers.
//
// Every function is safe to call from several threads at once on different pictures and files.
#pragma once

#include "celltrace/error.hpp"
#include "celltrace/export.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace celltrace {

/// Limits of what is loaded and saved: pixels a side, and pixels in all (512 MB of RGBA).
inline constexpr int kMaxImageSide = 65535;
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 27;

/// A picture: `height` rows of `width` pixels, top row first, four channels (red, green, blue, alpha) a
/// pixel, no padding.
template <class Channel> struct BasicImage {
  int width = 0;
  int height = 0;
  std::vector<Channel> rgba;

  BasicImage() = default;
  /// Opaque black. Throws InputError if a side is below 1 or a limit is passed.
  BasicImage(int width, int height);

  Channel* pixel(int x, int y) { return rgba.data() + offset(x, y); }
  const Channel* pixel(int x, int y) const { return rgba.data() + offset(x, y); }

  bool operator==(const BasicImage&) const = default;

private:
  std::size_t offset(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

/// Values are as files have them: encoded (sRGB by convention), alpha not premultiplied, the largest number
/// is opaque.
using Image = BasicImage<std::uint8_t>;
using DeepImage = BasicImage<std::uint16_t>;

/// Colours as numbers, as rays brought them: not clipped, alpha 0 to 1.
struct ColourImage : BasicImage<float> {
  using BasicImage::BasicImage;
  /// The power that makes colours linear. None: they are for display as they are.
  std::optional<double> gamma = 1.0;
};

/// For display: each colour clipped to 0..1, made linear and encoded as sRGB, with 16 bits a channel. What is
/// not a number becomes 0. Throws InputError if the picture is empty or too large.
CELLTRACE_EXPORT DeepImage to_deep_image(const ColourImage& colours);

/// Writes a picture as PNG (8 or 16 bits a channel; without alpha if every pixel is opaque) or, without its
/// alpha, as binary PPM, by the extension of `path` (.png or .ppm, in either case). The file appears whole or
/// not at all: it is written under another name in the same folder and renamed. A device or pipe is written
/// to directly. Throws InputError naming the file: unknown extension, picture without or with too many
/// pixels, failed write.
CELLTRACE_EXPORT void save_image(const std::filesystem::path& path, const Image& image);
CELLTRACE_EXPORT void save_image(const std::filesystem::path& path, const DeepImage& image);

/// The formats of pictures in memory.
enum class ImageFormat { png, ppm };

/// The bytes that save_image() would write. Throws InputError for a picture without or with too many pixels.
CELLTRACE_EXPORT std::vector<std::uint8_t> encode_image(const Image& image, ImageFormat format);
CELLTRACE_EXPORT std::vector<std::uint8_t> encode_image(const DeepImage& image, ImageFormat format);
/// As load_image() reads them. Throws InputError as that does.
CELLTRACE_EXPORT Image decode_image(const std::uint8_t* bytes, std::size_t count);

/// Throws the InputError save_image() would end with for this path's extension or folder, so that a program
/// can tell before it computes the picture.
CELLTRACE_EXPORT void check_image_path(const std::filesystem::path& path);

/// Reads a PNG (any bit depth, grey, palette, alpha, interlaced; 16 bits are rounded to 8; gamma chunks are
/// not applied) or a binary PPM (P6, any maximum), told apart by their content. Throws InputError naming the
/// file: unreadable, neither format, damaged, truncated, over the limits above, or too short for the size it
/// declares.
CELLTRACE_EXPORT Image load_image(const std::filesystem::path& path);

/// How far two pictures of the same size are apart.
struct CELLTRACE_EXPORT Comparison {
  int width = 0;
  int height = 0;
  /// Peak signal-to-noise ratio over red, green and blue in dB, peak 255; infinity if those are equal
  /// everywhere.
  double psnr = 0;
  /// Least structural similarity (Wang, Bovik, Sheikh and Simoncelli, 2004) of the luma of a block of 8x8
  /// pixels, every pixel of a block with the same weight; -1..1, 1 for equal blocks. The blocks tile the
  /// picture from the top left; those at the right and bottom edges are moved inwards to be whole, and a
  /// picture under 8 pixels wide or high has blocks as wide or high as itself.
  double worst_ssim = 1;
  /// Left and top pixel of that block; the first of several equal ones.
  int worst_x = 0;
  int worst_y = 0;
  /// Pixels that differ in any channel, alpha included.
  std::int64_t differing_pixels = 0;
  /// Largest difference in any channel, alpha included; 0..255.
  int max_difference = 0;
};

/// Throws InputError if the sizes differ or a picture is empty.
CELLTRACE_EXPORT Comparison compare_images(const Image& a, const Image& b);

/// One line for people: "PSNR 41.27 dB, worst 8x8 SSIM 0.9821 at (120, 64), 312 of 307200 pixels differ, by
/// 17 at most", or "identical, WxH pixels".
CELLTRACE_EXPORT std::string to_text(const Comparison& comparison);

/// A JSON object with the members of Comparison as keys and "identical". JSON has no infinity: an infinite
/// PSNR is null.
CELLTRACE_EXPORT std::string to_json(const Comparison& comparison);

/// The differences as an opaque picture: every channel of RGB is min(255, gain * |a - b|); black where equal.
/// Throws as compare_images(), and InputError for a gain outside 1..255.
CELLTRACE_EXPORT Image difference_image(const Image& a, const Image& b, int gain = 8);

} // namespace celltrace
