// What programs of others make of files that are written here.
#include "other_programs.hpp"

#include <cmath>

using namespace celltrace;
using namespace celltrace::test;

namespace {

/// Of many sizes from 2^`least` on, in `steps` powers of two.
ColourImage numbers(int least, int steps) {
  ColourImage image(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x)
      for (int channel = 0; channel < 3; ++channel)
        image.pixel(x, y)[channel] =
            std::ldexp(1.0f + 0.0307f * static_cast<float>(y), least + (x + 5 * channel) % steps);
  return image;
}

/// The greatest difference beyond `step`, as a share of `of(pixel, channel)`.
template <class Of>
double worst_of(const std::vector<double>& read, const ColourImage& written, double step, Of of) {
  REQUIRE(read.size() == written.rgba.size() / 4 * 3);
  double worst = 0;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const float* const pixel = written.rgba.data() + i / 3 * 4;
    const double off = std::fabs(read[i] - static_cast<double>(pixel[i % 3]));
    worst = std::max(worst, (off - step) / static_cast<double>(of(pixel, i % 3)));
  }
  return worst;
}

constexpr double kHalfFloat = 1.0 / 2048;
constexpr double kStep = 0.5 / 65535; // of ImageMagick's numbers

[[maybe_unused]] float itself(const float* pixel, std::size_t channel) {
  return pixel[channel];
}
float greatest(const float* pixel, std::size_t) {
  return std::max({pixel[0], pixel[1], pixel[2]});
}

} // namespace

TEST_CASE("ImageMagick reads Radiance's files to their precision") {
  if (!imagemagick_reads("HDR")) return;
  const TemporaryFolder folder;
  const ColourImage image = numbers(-13, 13);
  save_image(folder / "a.hdr", image);
  CHECK(worst_of(numbers_by_imagemagick(folder, "a.hdr"), image, kStep, greatest) <= 1.0 / 256);
}

TEST_CASE("ImageMagick decodes a DirectDraw surface to the same pixels") {
  if (!imagemagick_reads("DDS")) return;
  const TemporaryFolder folder;
  BlockImage blocks;
  blocks.width = 62;
  blocks.height = 31;
  for (int i = 0; i < 8 * blocks.columns() * blocks.rows(); ++i)
    blocks.blocks.push_back(static_cast<std::uint8_t>(i * i * 31 + i / 8 * 57));
  // Blocks of four colours: the first one is the greater one.
  for (std::size_t i = 0; i < blocks.blocks.size(); i += 8) {
    std::uint8_t* const ends = &blocks.blocks[i];
    if (ends[1] < ends[3]) std::swap(ends[1], ends[3]);
    if (ends[1] == ends[3]) ends[3] ^= 1, ends[1] |= 1, ends[3] &= 0xFE;
  }
  save_image(folder / "a.dds", blocks);
  CHECK(compare_images(by_imagemagick(folder, "a.dds"), to_image(blocks)).max_difference <= 1);
}

#ifdef CELLTRACE_HAS_OPENEXR
TEST_CASE("ImageMagick reads OpenEXR files to half floats' precision") {
  if (!imagemagick_reads("EXR")) return;
  const TemporaryFolder folder;
  const ColourImage image = numbers(-13, 13);
  for (const bool full_floats : {false, true}) {
    save_image(folder / "a.exr", image, {full_floats, nullptr});
    CHECK(worst_of(numbers_by_imagemagick(folder, "a.exr"), image, kStep, itself) <= kHalfFloat);
  }
}

TEST_CASE("ffmpeg, which has a reader of its own, reads OpenEXR files to their precision") {
  if (!is_able("ffmpeg -decoders | grep -q OpenEXR")) return;
  const TemporaryFolder folder;
  ColourImage image = numbers(-14, 29); // to where half floats end
  for (const bool has_alpha : {false, true})
    for (const bool full_floats : {false, true}) {
      CAPTURE(has_alpha, full_floats);
      image.pixel(3, 3)[3] = has_alpha ? 0.25f : 1;
      save_image(folder / "a.exr", image, {full_floats, nullptr});
      const std::string format = has_alpha ? "gbrapf32le" : "gbrpf32le";
      const std::string bytes =
          printed_by(folder, "ffmpeg -v error -i a.exr -f rawvideo -pix_fmt " + format + " - </dev/null");
      const std::vector<float> planes = numbers_in<float>(bytes);
      const std::size_t pixels = image.rgba.size() / 4;
      REQUIRE(planes.size() == pixels * (has_alpha ? 4 : 3));
      std::vector<double> read;
      for (std::size_t i = 0; i < pixels; ++i)
        for (const std::size_t plane : {2, 0, 1})
          read.push_back(static_cast<double>(planes[plane * pixels + i]));
      CHECK(worst_of(read, image, 0, itself) <= (full_floats ? 0 : kHalfFloat));
      if (has_alpha) CHECK(planes[3 * pixels + 3 * 64 + 3] == 0.25f);
    }
}
#endif
