// Pictures of 16 bits a channel, and how colours become them.
#include "picture_files.hpp"

#include <cstdio>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>
#include <png.h>

using namespace celltrace;
using namespace celltrace::test;

namespace {

/// The samples of a file, as another library reads them.
std::vector<std::uint16_t> samples_of(const std::filesystem::path& path, int& channels) {
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  REQUIRE(file != nullptr);
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  CHECK(png_get_bit_depth(png, info) == 16);
  channels = png_get_channels(png, info);
  std::vector<std::uint16_t> samples;
  for (png_uint_32 y = 0; y < png_get_image_height(png, info); ++y) {
    const png_bytep row = png_get_rows(png, info)[y];
    for (std::size_t i = 0; i < png_get_rowbytes(png, info); i += 2)
      samples.push_back(static_cast<std::uint16_t>(row[i] << 8 | row[i + 1]));
  }
  png_destroy_read_struct(&png, &info, nullptr);
  std::fclose(file);
  return samples;
}

std::vector<std::uint16_t> colours_of(const DeepImage& image) {
  std::vector<std::uint16_t> colours;
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    if (i % 4 != 3) colours.push_back(image.rgba[i]);
  return colours;
}

std::vector<int> encoded(const std::vector<float>& colours, std::optional<double> gamma) {
  ColourImage image(static_cast<int>(colours.size()), 1);
  image.gamma = gamma;
  for (std::size_t i = 0; i < colours.size(); ++i)
    image.rgba[4 * i] = colours[i];
  const DeepImage deep = to_deep_image(image);
  std::vector<int> values;
  for (std::size_t i = 0; i < colours.size(); ++i)
    values.push_back(deep.rgba[4 * i]);
  return values;
}

} // namespace

TEST_CASE("a picture of 16 bits survives PNG, with and without alpha") {
  const TemporaryFolder folder;
  DeepImage image = asymmetric_image<std::uint16_t>(37, 23);
  int channels = 0;
  save_image(folder / "a.png", image);
  CHECK(samples_of(folder / "a.png", channels) == colours_of(image));
  CHECK(channels == 3);

  image.pixel(36, 22)[3] = 0x1234;
  save_image(folder / "a.png", image);
  CHECK(samples_of(folder / "a.png", channels) == image.rgba);
  CHECK(channels == 4);
}

TEST_CASE("a picture of 16 bits survives PPM, whose numbers have the high byte first") {
  const TemporaryFolder folder;
  const DeepImage image = asymmetric_image<std::uint16_t>(5, 3);
  save_image(folder / "a.ppm", image);
  std::string expected = "P6\n5 3\n65535\n";
  for (const std::uint16_t value : colours_of(image)) {
    expected += static_cast<char>(value >> 8);
    expected += static_cast<char>(value & 0xFF);
  }
  CHECK(read_bytes(folder / "a.ppm") == expected);
}

TEST_CASE("colours are clipped and encoded") {
  // sRGB of 0.5 is 0.735357; the straight part ends at 0.0031308.
  CHECK(encoded({0, 0.5f, 1, 2, -1, 0.002f}, 1.0) == std::vector<int>{0, 48192, 65535, 65535, 0, 1693});
  CHECK(encoded({0.25f}, 2.0) == encoded({0.0625f}, 1.0));
  CHECK(encoded({0.5f, 0.25f}, std::nullopt) == std::vector<int>{32768, 16384});
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  CHECK(encoded({std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity}, 1.0) ==
        std::vector<int>{0, 65535, 0});
  CHECK_THROWS_AS(to_deep_image(ColourImage()), InputError);
}
