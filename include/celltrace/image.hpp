// Pictures in memory. Pictures with 8 bits a channel can be read from files, written to files and compared;
// pictures with 16 bits a channel, and colours as floats, can be written to files.
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

/// Limits of pictures that are loaded and saved: pixels a side, and pixels in all (512 MB of 8-bit RGBA).
inline constexpr int kMaxImageSide = 65535;
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 27;

/// A picture: `height` rows of `width` pixels, top row first, four channels (red, green, blue, alpha) a
/// pixel, no padding.
template <class Channel> struct BasicImage {
  int width = 0;
  int height = 0;
  std::vector<Channel> rgba;

  BasicImage() = default;
  /// Makes an opaque black picture. Throws InputError if a side is below 1 or a limit is passed.
  CELLTRACE_EXPORT BasicImage(int width, int height);

  Channel* pixel(int x, int y) { return rgba.data() + offset(x, y); }
  const Channel* pixel(int x, int y) const { return rgba.data() + offset(x, y); }

  bool operator==(const BasicImage&) const = default;

private:
  std::size_t offset(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

/// Pictures with the values that files contain: encoded (sRGB by convention), with alpha not premultiplied.
/// The largest alpha is opaque.
using Image = BasicImage<std::uint8_t>;
using DeepImage = BasicImage<std::uint16_t>;

/// Colours as floats, as computed along rays: not clipped, premultiplied with alpha, which is 0 to 1. To put
/// a picture in front of a background, add the background times 1 - alpha.
struct ColourImage : BasicImage<float> {
  using BasicImage::BasicImage;
  /// The exponent that makes the colours linear. None: the colours are already encoded for display.
  std::optional<double> gamma = 1.0;
};

/// Converts colours for display, to 16 or 8 bits a channel: they are divided by their alpha, clipped to 0..1,
/// made linear and encoded as sRGB. As in POV-Ray's pictures, alpha is at least the luminance of the colour,
/// so that reflections in clear surfaces stay visible. NaN becomes 0. Throws InputError if the picture is
/// empty or too large.
CELLTRACE_EXPORT DeepImage to_deep_image(const ColourImage& colours);
CELLTRACE_EXPORT Image to_image(const ColourImage& colours);

/// The first hit through the middle of each pixel, row by row.
struct FirstHits {
  int width = 0;
  int height = 0;
  /// Distance from the ray's origin, in the scene's unit; infinity if nothing is hit.
  std::vector<float> depth;
  std::vector<float> normal; ///< x, y, z a pixel, of length 1, on the side that is seen; 0 if nothing is hit
  /// A number that tells objects apart, 0 if nothing is hit: for an object with an interior, 1 +
  /// Object::interior, so that parts of a union that share an interior count as one object; for an object
  /// without an interior, 1 + the number of interiors + its index in Scene::objects (RayHit::object).
  std::vector<std::uint32_t> object;
};

/// A picture in BC1, an eighth of the size of RGBA8: blocks of 4x4 pixels, row by row, 8 bytes each. A block
/// has two colours of 5, 6 and 5 bits (low byte first, the greater colour first) and two bits a pixel, the
/// first pixel in the lowest bits: 0 and 1 are the two colours, 2 and 3 the blends at one and two thirds of
/// the way from the first colour to the second. Pixels beyond the right and lower edges mean nothing.
struct BlockImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> blocks;

  int columns() const { return (width + 3) / 4; }
  int rows() const { return (height + 3) / 4; }
};
/// Returns the decoded pixels, opaque. Throws InputError if the picture is empty or too large, or if the
/// number of blocks does not fit its size.
CELLTRACE_EXPORT Image to_image(const BlockImage& blocks);

/// The formats of picture files, with the types of pictures that each format can store.
enum class ImageFormat {
  png, ///< Image and DeepImage: 8 or 16 bits a channel, without alpha if every pixel is opaque
  ppm, ///< Image and DeepImage: binary, always without alpha; grey pictures are PGM
  exr, ///< ColourImage: OpenEXR, linear, with alpha unless every pixel is opaque; if the build has OpenEXR
  hdr, ///< ColourImage: Radiance's RGBE, linear, without alpha
  dds, ///< BlockImage: a DirectDraw surface of format DXT1
  tga, ///< Image: Truevision's Targa, without alpha if every pixel is opaque
  bmp, ///< Image: Windows' bitmap, without alpha if every pixel is opaque
  jpeg ///< Image: JPEG (baseline), without alpha; if the build has libjpeg
};

/// The encoding of values in files of 8 and 16 bits a channel: sRGB, or a power.
struct FileGamma {
  std::optional<double> power; ///< exponent that makes values linear; none: sRGB

  bool operator==(const FileGamma&) const = default;
};
/// Returns the format that the extension of `path`, in upper or lower case, stands for. Throws InputError if
/// the extension is unknown, or if the build cannot write the format.
CELLTRACE_EXPORT ImageFormat image_format_of(const std::filesystem::path& path);
/// Returns true if the format is written from a ColourImage.
constexpr bool holds_numbers(ImageFormat format) {
  return format == ImageFormat::exr || format == ImageFormat::hdr;
}

/// Options for OpenEXR files. By default the file has only colours, of 16 bits a channel.
struct ExrOptions {
  bool full_floats = false; ///< true: colours and normals have 32 bits a channel
  /// First hits of the picture's size, written as channels Z (32 bits), N.X, N.Y, N.Z and id (whole numbers).
  /// Null: none.
  const FirstHits* first_hits = nullptr;
};

/// Options of a picture file; a format ignores options that do not concern it.
struct FileOptions {
  /// None: the format of the path's extension; only save_image() uses this member.
  std::optional<ImageFormat> format;
  /// True: the file has alpha if its format has. None: the file has alpha if its format has and a pixel is
  /// not opaque.
  std::optional<bool> alpha;
  /// True: the file has only the luminance of the colours. For PNG, PPM (which becomes a PGM), TGA and JPEG.
  bool grey = false;
  /// The encoding that Image and DeepImage have, and to which a ColourImage is converted.
  FileGamma gamma;
  int bits = 8;             ///< bits a channel, 8 or 16, of a ColourImage in a PNG or PPM
  int jpeg_quality = 85;    ///< 0 to 100; POV-Ray's default
  bool run_lengths = false; ///< true: TGA is compressed by run lengths
};

/// Writes a picture in the format that `options` or the extension of `path` names. The file appears whole or
/// not at all: it is written under another name in the same folder and renamed. An existing file keeps its
/// mode, owner and hard links; it is an error if the file's permissions forbid writing. A device, a pipe or
/// an open descriptor (/dev/stdout, /dev/fd/3) is written to directly. Throws InputError, naming the file,
/// for an unknown extension, a format that does not take such pictures, a picture without or with too many
/// pixels, and a failed write.
CELLTRACE_EXPORT void save_image(const std::filesystem::path& path, const Image& image,
                                 const FileOptions& options = {});
CELLTRACE_EXPORT void save_image(const std::filesystem::path& path, const DeepImage& image,
                                 const FileOptions& options = {});
/// As above, for colours as floats. OpenEXR and Radiance files get linear colours: up to 65504 in OpenEXR's
/// 16 bits, and not below 0 in RGBE. Other formats get encoded colours, as from to_image() and
/// to_deep_image(), but in front of black if the format has no alpha.
CELLTRACE_EXPORT void save_image(const std::filesystem::path& path, const ColourImage& colours,
                                 const ExrOptions& exr = {}, const FileOptions& options = {});
CELLTRACE_EXPORT void save_image(const std::filesystem::path& path, const BlockImage& blocks,
                                 const FileOptions& options = {});

/// Writes a picture as save_image() does, to the end of an open stream, and flushes the stream. Throws
/// InputError, with a message that names no file.
CELLTRACE_EXPORT void write_image(std::FILE* file, ImageFormat format, const Image& image,
                                  const FileOptions& options = {});
CELLTRACE_EXPORT void write_image(std::FILE* file, ImageFormat format, const DeepImage& image,
                                  const FileOptions& options = {});
CELLTRACE_EXPORT void write_image(std::FILE* file, ImageFormat format, const ColourImage& colours,
                                  const ExrOptions& exr = {}, const FileOptions& options = {});
CELLTRACE_EXPORT void write_image(std::FILE* file, ImageFormat format, const BlockImage& blocks,
                                  const FileOptions& options = {});

/// Return the bytes of the file that save_image() would write.
CELLTRACE_EXPORT std::vector<std::uint8_t> encode_image(const Image& image, ImageFormat format,
                                                        const FileOptions& options = {});
CELLTRACE_EXPORT std::vector<std::uint8_t> encode_image(const DeepImage& image, ImageFormat format,
                                                        const FileOptions& options = {});
CELLTRACE_EXPORT std::vector<std::uint8_t> encode_image(const ColourImage& colours, ImageFormat format,
                                                        const ExrOptions& exr = {},
                                                        const FileOptions& options = {});
CELLTRACE_EXPORT std::vector<std::uint8_t> encode_image(const BlockImage& blocks, ImageFormat format);
/// Decodes the bytes of a picture file in any format that load_image() reads. Throws InputError as
/// load_image() does, without a file name.
CELLTRACE_EXPORT Image decode_image(const std::uint8_t* bytes, std::size_t count);

/// Throws the InputError that save_image() would throw because of the path's extension, folder or file, so
/// that a program can fail before it computes the picture. `format`: as in FileOptions.
CELLTRACE_EXPORT void check_image_path(const std::filesystem::path& path,
                                       std::optional<ImageFormat> format = {});

/// Reads a PNG (any bit depth, grey, palette, alpha, interlaced; 16 bits are rounded to 8; gamma chunks are
/// not applied), a binary PPM (P6, any maximum), a BMP (24 or 32 bits a pixel, not compressed), a JPEG (if
/// the build has libjpeg) or a TGA of version 2 (8 bits a channel, no palette). The format is detected from
/// the content, not from the name. Throws InputError, naming the file, if it is unreadable, of another
/// format, damaged, truncated, over the limits above, or too short for the size it declares.
CELLTRACE_EXPORT Image load_image(const std::filesystem::path& path);

/// The differences between two pictures of the same size.
struct CELLTRACE_EXPORT Comparison {
  int width = 0;
  int height = 0;
  /// Peak signal-to-noise ratio over red, green and blue in dB, peak 255; infinity if red, green and blue are
  /// equal everywhere.
  double psnr = 0;
  /// Least structural similarity (Wang, Bovik, Sheikh and Simoncelli, 2004) of the luma of a block of 8x8
  /// pixels, with equal weights for all pixels of a block; -1..1, 1 for equal blocks. The blocks tile the
  /// picture from the top left; blocks that would cross the right or bottom edge are moved inwards. A picture
  /// less than 8 pixels wide or high has blocks as wide or high as itself.
  double worst_ssim = 1;
  /// Column and row of the first pixel of the block with the least similarity; of several equal blocks, the
  /// first.
  int worst_x = 0;
  int worst_y = 0;
  /// Number of pixels that differ in any channel, alpha included.
  std::int64_t differing_pixels = 0;
  /// Largest difference in any channel, alpha included; 0..255.
  int max_difference = 0;
};

/// Compares two pictures. Throws InputError if the sizes differ or a picture is empty.
CELLTRACE_EXPORT Comparison compare_images(const Image& a, const Image& b);

/// Returns one line for people: "PSNR 41.27 dB, worst 8x8 SSIM 0.9821 at (120, 64), 312 of 307200 pixels
/// differ, by 17 at most", or "identical, WxH pixels".
CELLTRACE_EXPORT std::string to_text(const Comparison& comparison);

/// Returns a JSON object with the members of Comparison as keys and "identical". JSON has no infinity: an
/// infinite PSNR is null.
CELLTRACE_EXPORT std::string to_json(const Comparison& comparison);

/// Returns the differences as an opaque picture: every channel of RGB is min(255, gain * |a - b|), black if
/// equal. Throws as compare_images() does, and InputError for a gain outside 1..255.
CELLTRACE_EXPORT Image difference_image(const Image& a, const Image& b, int gain = 8);

} // namespace celltrace
