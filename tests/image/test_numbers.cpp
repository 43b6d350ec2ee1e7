// Colours as numbers in files: OpenEXR, Radiance; and their pixels for display.
#include "picture_files.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include <catch2/catch.hpp>

#ifdef CELLTRACE_HAS_OPENEXR
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#endif

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

/// Numbers of many sizes, none of them negative.
ColourImage numbers(int width, int height) {
  ColourImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel)
        image.pixel(x, y)[channel] =
            x < width / 2 ? 0.25f : std::ldexp(1.0f + 0.01f * static_cast<float>(y), x % 21 - 10 + channel);
  return image;
}

/// A reader of Radiance's files as its documents describe them.
ColourImage read_radiance(const std::filesystem::path& path) {
  std::istringstream file(read_bytes(path));
  std::string line;
  std::getline(file, line);
  REQUIRE(line == "#?RADIANCE");
  bool has_format = false;
  while (std::getline(file, line) && !line.empty())
    has_format = has_format || line == "FORMAT=32-bit_rle_rgbe";
  REQUIRE(has_format);
  std::string minus_y, plus_x;
  int width = 0, height = 0;
  file >> minus_y >> height >> plus_x >> width;
  REQUIRE(minus_y == "-Y");
  REQUIRE(plus_x == "+X");
  file.get();
  const auto byte = [&] {
    const int c = file.get();
    REQUIRE(c >= 0);
    return c;
  };
  ColourImage image(width, height);
  std::vector<int> row(4 * static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    if (width >= 8) {
      REQUIRE(byte() == 2);
      REQUIRE(byte() == 2);
      const int high = byte();
      REQUIRE(256 * high + byte() == width);
      for (std::size_t channel = 0; channel < 4; ++channel)
        for (int x = 0; x < width;) {
          const int count = byte();
          const bool is_run = count > 128;
          const int repeated = is_run ? byte() : 0;
          for (int i = 0; i < (is_run ? count - 128 : count); ++i, ++x) {
            REQUIRE(x < width);
            row[4 * static_cast<std::size_t>(x) + channel] = is_run ? repeated : byte();
          }
        }
    } else {
      for (int& value : row)
        value = byte();
    }
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel) {
        const int* const pixel = row.data() + 4 * x;
        image.pixel(x, y)[channel] =
            pixel[3] == 0 ? 0 : std::ldexp(static_cast<float>(pixel[channel]), pixel[3] - 136);
      }
  }
  CHECK(file.get() == std::istringstream::traits_type::eof());
  return image;
}

/// RGBE has 8 bits for the greatest channel.
void check_radiance(const ColourImage& read, const ColourImage& written) {
  REQUIRE(read.width == written.width);
  REQUIRE(read.height == written.height);
  float worst = 0;
  for (int y = 0; y < written.height; ++y)
    for (int x = 0; x < written.width; ++x) {
      const float* const is = read.pixel(x, y);
      const float* const was = written.pixel(x, y);
      const float greatest = std::max({was[0], was[1], was[2]});
      for (int channel = 0; channel < 3; ++channel)
        worst = std::max(worst, std::fabs(is[channel] - was[channel]) / greatest);
    }
  CHECK(worst <= 1.0f / 256);
}

} // namespace

TEST_CASE("colours survive a Radiance file to its precision") {
  const TemporaryFolder folder;
  for (const int width : {7, 8, 200, 1000}) {
    CAPTURE(width);
    const ColourImage image = numbers(width, 5);
    save_image(folder / "a.HDR", image);
    check_radiance(read_radiance(folder / "a.HDR"), image);
  }
}

TEST_CASE("a Radiance file has what can be seen of extreme colours") {
  const TemporaryFolder folder;
  ColourImage image(4, 1);
  const float infinite = std::numeric_limits<float>::infinity();
  const float channels[4][3] = {{-1, 0.5f, std::numeric_limits<float>::quiet_NaN()},
                                {infinite, 0, 0},
                                {1e-38f, 0, 0},
                                {0.999f, 0.999f, 0.999f}};
  for (int x = 0; x < 4; ++x)
    std::copy_n(channels[x], 3, image.pixel(x, 0));
  save_image(folder / "a.hdr", image);
  const ColourImage read = read_radiance(folder / "a.hdr");
  CHECK(read.pixel(0, 0)[0] == 0);
  CHECK(read.pixel(0, 0)[1] == 0.5f);
  CHECK(read.pixel(0, 0)[2] == 0);
  CHECK(read.pixel(1, 0)[0] > 1e37f);
  CHECK(read.pixel(2, 0)[0] == 0);
  CHECK(read.pixel(3, 0)[0] == 1);
}

TEST_CASE("colours for display become amounts of light in files of numbers") {
  const TemporaryFolder folder;
  ColourImage image(1, 1);
  image.pixel(0, 0)[0] = 0.5f;
  image.gamma = 2.0;
  save_image(folder / "a.hdr", image);
  CHECK(read_radiance(folder / "a.hdr").pixel(0, 0)[0] == Approx(0.25).epsilon(0.004));
  image.gamma = std::nullopt;
  save_image(folder / "a.hdr", image);
  CHECK(read_radiance(folder / "a.hdr").pixel(0, 0)[0] == Approx(0.2140).epsilon(0.004));
}

TEST_CASE("pictures are for the formats that can hold them") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(save_image(folder / "a.hdr", asymmetric_image(4, 4)),
                    Contains("a.hdr: ") && Contains("numbers"));
  CHECK_THROWS_WITH(save_image(folder / "a.dds", asymmetric_image(4, 4)),
                    Contains("a.dds: ") && Contains("blocks"));
  CHECK_THROWS_WITH(save_image(folder / "a.dds", numbers(4, 4)), Contains("a.dds: ") && Contains("blocks"));
  CHECK_THROWS_WITH(save_image(folder / "missing/a.hdr", numbers(4, 4)), Contains("missing/a.hdr"));
  CHECK_THROWS_WITH(save_image(folder / "a.hdr", ColourImage()), Contains("is empty"));
  CHECK(std::filesystem::is_empty(folder.path()));
  if (std::filesystem::exists("/dev/full")) {
    std::filesystem::create_symlink("/dev/full", folder / "full.hdr");
    CHECK_THROWS_WITH(save_image(folder / "full.hdr", numbers(200, 200)), Contains("cannot be written"));
  }
}

TEST_CASE("alpha is taken out of colours for display, and is at least what shines") {
  ColourImage image(3, 1);
  const float pixels[3][4] = {{0.25f, 0.125f, 0, 0.5f}, {0.125f, 0.0625f, 0.25f, 0}, {0, 0, 0, 0}};
  for (int x = 0; x < 3; ++x)
    std::copy_n(pixels[x], 4, image.pixel(x, 0));
  image.gamma = std::nullopt;
  const DeepImage deep = to_deep_image(image);
  CHECK(std::vector<int>(deep.pixel(0, 0), deep.pixel(0, 0) + 4) == std::vector<int>{32768, 16384, 0, 32768});
  // Measured in POV-Ray's pictures.
  CHECK(std::vector<int>(deep.pixel(1, 0), deep.pixel(1, 0) + 4) ==
        std::vector<int>{65535, 39985, 65535, 6713});
  CHECK(std::vector<int>(deep.pixel(2, 0), deep.pixel(2, 0) + 4) == std::vector<int>{0, 0, 0, 0});
  CHECK(to_image(image).rgba[3] == 128);
}

#ifdef CELLTRACE_HAS_OPENEXR
namespace {

/// A channel of a file as floats.
std::vector<float> channel_of(const std::filesystem::path& path, const char* name) {
  Imf::InputFile file(path.c_str());
  const Imath::Box2i window = file.header().dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
  const auto height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
  std::vector<float> values(width * height);
  Imf::FrameBuffer frame;
  frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 4 * width));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return values;
}
std::string channels_in(const std::filesystem::path& path) {
  Imf::InputFile file(path.c_str());
  std::string names;
  const Imf::ChannelList& channels = file.header().channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
    names += std::string(channel.name()) + ":" + std::to_string(channel.channel().type) + " ";
  return names;
}
/// Of the pixels of a picture.
std::vector<float> values_of(const ColourImage& image, std::size_t channel) {
  std::vector<float> values;
  for (std::size_t i = channel; i < image.rgba.size(); i += 4)
    values.push_back(image.rgba[i]);
  return values;
}

} // namespace

TEST_CASE("colours survive an OpenEXR file: whole, or to half floats' precision") {
  const TemporaryFolder folder;
  ColourImage image = numbers(70, 9);
  image.pixel(3, 3)[1] = -2;
  image.pixel(4, 4)[1] = 1e6f;
  save_image(folder / "full.exr", image, {true, nullptr});
  CHECK(channels_in(folder / "full.exr") == "B:2 G:2 R:2 ");
  CHECK(channel_of(folder / "full.exr", "G") == values_of(image, 1));
  image.pixel(5, 5)[3] = 0.5f;
  save_image(folder / "half.exr", image);
  CHECK(channels_in(folder / "half.exr") == "A:1 B:1 G:1 R:1 ");
  image.pixel(4, 4)[1] = 65504;
  const std::vector<float> read = channel_of(folder / "half.exr", "G"), written = values_of(image, 1);
  float worst = 0;
  for (std::size_t i = 0; i < read.size(); ++i)
    worst = std::max(worst, std::fabs(read[i] - written[i]) / std::fabs(written[i]));
  CHECK(worst <= 1.0f / 2048);
  CHECK(channel_of(folder / "half.exr", "A") == values_of(image, 3));
}

TEST_CASE("an OpenEXR file has what is seen first besides") {
  const TemporaryFolder folder;
  const ColourImage image = numbers(5, 3);
  FirstHits hits;
  hits.width = 5;
  hits.height = 3;
  for (std::uint32_t i = 0; i < 15; ++i) {
    hits.depth.push_back(i == 4 ? std::numeric_limits<float>::infinity() : 100000.5f + static_cast<float>(i));
    hits.object.push_back(i * 1000000);
    for (int axis = 0; axis < 3; ++axis)
      hits.normal.push_back(static_cast<float>(axis) * 0.25f - static_cast<float>(i) * 0.0625f);
  }
  save_image(folder / "a.exr", image, {false, &hits});
  CHECK(channels_in(folder / "a.exr") == "B:1 G:1 N.X:1 N.Y:1 N.Z:1 R:1 Z:2 id:0 ");
  CHECK(channel_of(folder / "a.exr", "Z") == hits.depth);
  CHECK(channel_of(folder / "a.exr", "id")[14] == 14000000);
  const std::vector<float> y = channel_of(folder / "a.exr", "N.Y");
  for (std::size_t i = 0; i < 15; ++i)
    CHECK(y[i] == hits.normal[3 * i + 1]);
  hits.height = 4;
  CHECK_THROWS_WITH(save_image(folder / "b.exr", image, {false, &hits}), Contains("does not match"));
  CHECK_FALSE(std::filesystem::exists(folder / "b.exr"));
}
#else
TEST_CASE("without OpenEXR the error says so before anything is rendered") {
  CHECK_THROWS_WITH(check_image_path("a.exr"), Contains("a.exr: this build cannot write OpenEXR"));
  CHECK_THROWS_WITH(save_image("a.exr", numbers(4, 4)), Contains("a.exr: this build cannot write OpenEXR"));
}
#endif
