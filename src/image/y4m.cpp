#include "image/y4m.hpp"

#include <cerrno>
#include <cstdint>
#include <system_error>
#include <vector>

namespace celltrace::image {

namespace {

void check(bool written) {
  if (!written) throw InputError("cannot be written: " + std::generic_category().message(errno));
}

/// Weights of red, green and blue in units of 2^-16, and an offset.
struct Component {
  std::int32_t red, green, blue, offset;
};
/// BT.601 with luma 16..235 and chroma 16..240. White is 235 and greys have chroma 128 exactly, because the
/// weights of luma sum up to 219 / 255 and those of chroma to 0.
constexpr Component kLuma = {16829, 33039, 6416, 16}, kCb = {-9714, -19070, 28784, 128},
                    kCr = {28784, -24103, -4681, 128};
static_assert(kLuma.red + kLuma.green + kLuma.blue == (219 * 65536 + 127) / 255);
static_assert(kCb.red + kCb.green + kCb.blue == 0 && kCr.red + kCr.green + kCr.blue == 0);

std::uint8_t encoded(const Component& c, const std::uint8_t* pixel) {
  const std::int32_t sum = c.red * pixel[0] + c.green * pixel[1] + c.blue * pixel[2];
  return static_cast<std::uint8_t>((sum + (c.offset << 16) + (1 << 15)) >> 16);
}

} // namespace

void write_y4m_header(std::FILE* file, int width, int height, unsigned frames, unsigned seconds) {
  check(std::fprintf(file, "YUV4MPEG2 W%d H%d F%u:%u Ip A1:1 C444 XCOLORRANGE=LIMITED\n", width, height,
                     frames, seconds) > 0);
}

void write_y4m_frame(std::FILE* file, const Image& image) {
  const std::size_t pixels = image.rgba.size() / 4;
  std::vector<std::uint8_t> plane(pixels);
  check(std::fputs("FRAME\n", file) >= 0);
  for (const Component& component : {kLuma, kCb, kCr}) {
    for (std::size_t i = 0; i < pixels; ++i)
      plane[i] = encoded(component, &image.rgba[4 * i]);
    check(std::fwrite(plane.data(), 1, pixels, file) == pixels);
  }
}

} // namespace celltrace::image
