// Pictures to and from memory.
#include "picture_files.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

Image decode(const std::string& bytes) {
  return decode_image(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

} // namespace

TEST_CASE("a picture in memory has the bytes of its file") {
  const TemporaryFolder folder;
  const Image image = asymmetric_image(11, 5);
  DeepImage deep(3, 2);
  deep.pixel(1, 1)[0] = 300;
  const auto as_text = [](const std::vector<std::uint8_t>& bytes) {
    return std::string(bytes.begin(), bytes.end());
  };
  for (const auto& [name, format] : {std::pair("a.png", ImageFormat::png), {"a.ppm", ImageFormat::ppm}}) {
    save_image(folder / name, image);
    const std::string bytes = read_bytes(folder / name);
    CHECK(as_text(encode_image(image, format)) == bytes);
    CHECK(decode(bytes) == load_image(folder / name));
    save_image(folder / name, deep);
    CHECK(as_text(encode_image(deep, format)) == read_bytes(folder / name));
  }
}

TEST_CASE("bytes that are no picture are refused as files are") {
  CHECK_THROWS_WITH(decode(""), Contains("is empty"));
  CHECK_THROWS_WITH(decode("GIF89a"), Contains("neither a PNG nor"));
  CHECK_THROWS_AS(decode("P6 2 2 255\n123"), InputError);
  CHECK_THROWS_AS(encode_image(Image(), ImageFormat::png), InputError);
  const auto png = encode_image(Image(40, 40), ImageFormat::png);
  CHECK_THROWS_AS(decode_image(png.data(), png.size() / 2), InputError);
}
