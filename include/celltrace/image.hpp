// Pictures in memory: of 8 bits a channel, read from and written to files, and compared with each other; of
// 16, and colours as numbers, written to files.
//
// Every function is safe to call from several threads at once on different pictures and files.
#pragma once

#include "celltrace/error.hpp"
#include "celltrace/export.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
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
  CELLTRACE_EXPORT BasicImage(int width, int height);

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

/// Colours as numbers, as rays brought them: not clipped, alpha 0 to 1. They are premultiplied: what is
/// behind a pixel is added to them, times 1 - alpha.
struct ColourImage : BasicImage<float> {
  using BasicImage::BasicImage;
  /// The power that makes colours linear. None: they are for display as they are.
  std::optional<double> gamma = 1.0;
};

/// For display, with 16 or 8 bits a channel: colours are divided by their alpha, clipped to 0..1, made linear
/// and encoded as sRGB. As in POV-Ray's pictures, alpha is at least the luminance of the colour, so that what
/// clear surfaces mirror can be seen. What is not a number becomes 0. Throws InputError if the picture is
/// empty or too large.
CELLTRACE_EXPORT DeepImage to_deep_image(const ColourImage& colours);
CELLTRACE_EXPORT Image to_image(const ColourImage& colours);

/// What is seen first through the middle of each pixel, row by row.
struct FirstHits {
  int width = 0;
  int height = 0;
  std::vector<float> depth;  ///< from where the ray starts, in the scene's unit; infinity where nothing is
  std::vector<float> normal; ///< x, y, z a pixel, of length 1, to the side that is seen; 0 where nothing is
  /// A number by which objects are told apart, 0 where nothing is: 1 + the index in Scene::interiors of what
  /// is seen, so that the parts of a union that share one are one object; for an object without an interior 1
  /// + the number of interiors + its index in Scene::objects, which is RayHit::object.
  std::vector<std::uint32_t> object;
};

/// A picture in BC1, an eighth of RGBA8: blocks of 4x4 pixels, row by row, 8 bytes each. They have two
/// colours of 5, 6 and 5 bits (low byte first, the greater one first) and two bits a pixel, the first pixel
/// in the lowest ones: 0 and 1 are these colours, 2 and 3 the ones that are a third and two thirds of the way
/// from the first one to the second one. Pixels beyond the right and lower edges mean nothing.
struct BlockImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> blocks;

  int columns() const { return (width + 3) / 4; }
  int rows() const { return (height + 3) / 4; }
};
/// The pixels, opaque. Throws InputError if the picture is empty, too large, or not as large as it says.
CELLTRACE_EXPORT Image to_image(const BlockImage& blocks);

/// The formats that pictures are written in, by the extensions of their files.
enum class ImageFormat {
  png, ///< Image and DeepImage: 8 or 16 bits a channel, without alpha if every pixel is opaque
  ppm, ///< the same, binary, always without alpha; of grey pictures PGM
  exr, ///< ColourImage: OpenEXR, linear, with alpha unless every pixel is opaque; if the build has OpenEXR
  hdr, ///< ColourImage: Radiance's RGBE, linear, without alpha
  dds, ///< BlockImage: a DirectDraw surface of format DXT1
  tga, ///< Image: Truevision's Targa, without alpha if every pixel is opaque
  bmp, ///< the same, Windows' bitmap
  jpeg ///< Image: JPEG (baseline), without alpha; if the build has libjpeg
};

/// The encoding of files of 8 and 16 bits a channel: sRGB's, or a power.
struct FileGamma {
  std::optional<double> power; ///< light is the value to this power; none: sRGB

  bool operator==(const FileGamma&) const = default;
};
/// By the extension of `path`, in either case. Throws InputError if it is none of these, or if the build
/// cannot write it.
CELLTRACE_EXPORT ImageFormat image_format_of(const std::filesystem::path& path);
/// Whether colours as numbers are wanted for it.
constexpr bool holds_numbers(ImageFormat format) {
  return format == ImageFormat::exr || format == ImageFormat::hdr;
}

/// What is in an OpenEXR file besides colours, of 16 bits a channel.
struct ExrOptions {
  bool full_floats = false; ///< colours and normals have 32 bits a channel
  /// Channels Z (32 bits), N.X, N.Y, N.Z and id (whole numbers). Of the picture's size, or null: none.
  const FirstHits* first_hits = nullptr;
};

/// How a picture is stored, where its format leaves a choice.
struct FileOptions {
  std::optional<ImageFormat> format; ///< none: by the extension of the path; only save_image() asks
  /// Whether the file has alpha, if its format has; none: unless every pixel is opaque.
  std::optional<bool> alpha;
  /// Whether the file has the luminance of colours only: PNG, PPM (which is a PGM then), TGA and JPEG.
  bool grey = false;
  /// The encoding of an Image's and a DeepImage's values; colours as numbers are encoded so.
  FileGamma gamma;
  int bits = 8;             ///< a channel, of colours as numbers in a PNG or PPM: 8 or 16
  int jpeg_quality = 85;    ///< 0 to 100; POV-Ray's default
  bool run_lengths = false; ///< TGA is compressed
};

/// Writes a picture in the format that the extension of `path` says. The file appears whole or not at all: it
/// is written under another name in the same folder and renamed. One that is there keeps its mode, owner and
/// hard links; if it has no permission to write, it is an error. A device, a pipe or an open descriptor
/// (/dev/stdout, /dev/fd/3) is written to directly. Throws InputError naming the file: unknown extension, a
/// format for other pictures, picture without or with too many pixels, failed write.
CELLTRACE_EXPORT void save_image(const std::filesystem::path& path, const Image& image,
                                 const FileOptions& options = {});
CELLTRACE_EXPORT void save_image(const std::filesystem::path& path, const DeepImage& image,
                                 const FileOptions& options = {});
/// OpenEXR and Radiance: colours that are not linear become so; OpenEXR's 16 bits end at 65504, RGBE has
/// nothing below 0. Other formats get them encoded, as to_image() and to_deep_image() do, but in front of
/// black where they have no alpha.
CELLTRACE_EXPORT void save_image(const std::filesystem::path& path, const ColourImage& colours,
                                 const ExrOptions& exr = {}, const FileOptions& options = {});
CELLTRACE_EXPORT void save_image(const std::filesystem::path& path, const BlockImage& blocks,
                                 const FileOptions& options = {});

/// The same, to the end of an open stream, which is flushed. Throws InputError without a name.
CELLTRACE_EXPORT void write_image(std::FILE* file, ImageFormat format, const Image& image,
                                  const FileOptions& options = {});
CELLTRACE_EXPORT void write_image(std::FILE* file, ImageFormat format, const DeepImage& image,
                                  const FileOptions& options = {});
CELLTRACE_EXPORT void write_image(std::FILE* file, ImageFormat format, const ColourImage& colours,
                                  const ExrOptions& exr = {}, const FileOptions& options = {});
CELLTRACE_EXPORT void write_image(std::FILE* file, ImageFormat format, const BlockImage& blocks,
                                  const FileOptions& options = {});

/// The same, into memory.
CELLTRACE_EXPORT std::vector<std::uint8_t> encode_image(const Image& image, ImageFormat format,
                                                        const FileOptions& options = {});
CELLTRACE_EXPORT std::vector<std::uint8_t> encode_image(const DeepImage& image, ImageFormat format,
                                                        const FileOptions& options = {});
CELLTRACE_EXPORT std::vector<std::uint8_t> encode_image(const ColourImage& colours, ImageFormat format,
                                                        const ExrOptions& exr = {},
                                                        const FileOptions& options = {});
CELLTRACE_EXPORT std::vector<std::uint8_t> encode_image(const BlockImage& blocks, ImageFormat format);
/// As load_image() reads them. Throws InputError as that does.
CELLTRACE_EXPORT Image decode_image(const std::uint8_t* bytes, std::size_t count);

/// Throws the InputError save_image() would end with for this path's extension, folder or file, so that a
/// program can tell before it computes the picture. `format` as FileOptions::format.
CELLTRACE_EXPORT void check_image_path(const std::filesystem::path& path,
                                       std::optional<ImageFormat> format = {});

/// Reads a PNG (any bit depth, grey, palette, alpha, interlaced; 16 bits are rounded to 8; gamma chunks are
/// not applied), a binary PPM (P6, any maximum), a BMP (24 or 32 bits a pixel, not compressed), a JPEG (if
/// the build has libjpeg) or a TGA of version 2 (8 bits a channel, no palette), told apart by their content.
/// Throws InputError naming the file: unreadable, no such format, damaged, truncated, over the limits above,
/// or too short for the size it declares.
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
