// Pictures in blocks, in files and as pixels.
#include "picture_files.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

/// 6x5 pixels: the first block between red and blue, the others black.
BlockImage blocks() {
  BlockImage image;
  image.width = 6;
  image.height = 5;
  image.blocks.resize(32);
  const std::uint8_t first[8] = {0x00, 0xF8, 0x1F, 0x00, 0b11100100, 0, 0, 0};
  std::copy_n(first, 8, image.blocks.begin());
  return image;
}

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;)
    word = word << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return word;
}

std::vector<int> pixel_of(const Image& image, int x, int y) {
  return {image.pixel(x, y), image.pixel(x, y) + 4};
}

} // namespace

TEST_CASE("blocks become pixels") {
  const Image image = to_image(blocks());
  CHECK(image.width == 6);
  CHECK(image.height == 5);
  CHECK(pixel_of(image, 0, 0) == std::vector<int>{255, 0, 0, 255});
  CHECK(pixel_of(image, 1, 0) == std::vector<int>{0, 0, 255, 255});
  CHECK(pixel_of(image, 2, 0) == std::vector<int>{170, 0, 85, 255});
  CHECK(pixel_of(image, 3, 0) == std::vector<int>{85, 0, 170, 255});
  CHECK(pixel_of(image, 0, 1) == std::vector<int>{255, 0, 0, 255});
  CHECK(pixel_of(image, 5, 4) == std::vector<int>{0, 0, 0, 255});
}

TEST_CASE("a DirectDraw surface has the header that its readers ask for") {
  const TemporaryFolder folder;
  save_image(folder / "a.DDS", blocks());
  const std::string bytes = read_bytes(folder / "a.DDS");
  REQUIRE(bytes.size() == 128 + 32);
  CHECK(bytes.substr(0, 4) == "DDS ");
  CHECK(word_at(bytes, 4) == 124);
  CHECK(word_at(bytes, 12) == 5);
  CHECK(word_at(bytes, 16) == 6);
  CHECK(word_at(bytes, 20) == 32);
  CHECK(bytes.substr(84, 4) == "DXT1");
  CHECK(static_cast<std::uint8_t>(bytes[129]) == 0xF8);
}

TEST_CASE("blocks that do not match their size are refused") {
  const TemporaryFolder folder;
  BlockImage image = blocks();
  image.width = 9;
  CHECK_THROWS_WITH(save_image(folder / "a.dds", image), Contains("a.dds: ") && Contains("do not match"));
  CHECK_THROWS_AS(to_image(image), InputError);
  CHECK_THROWS_AS(to_image(BlockImage()), InputError);
  CHECK_THROWS_WITH(save_image(folder / "a.png", blocks()), Contains("a.png: ") && Contains("blocks"));
  CHECK(std::filesystem::is_empty(folder.path()));
}
