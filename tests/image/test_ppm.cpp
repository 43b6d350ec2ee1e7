#include "picture_files.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

Image load_ppm(const std::string& bytes) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.ppm", bytes);
  return load_image(folder / "a.ppm");
}

} // namespace

TEST_CASE("a picture survives PPM") {
  const TemporaryFolder folder;
  const Image image = asymmetric_image(11, 5);
  save_image(folder / "a.ppm", image);
  CHECK(load_image(folder / "a.ppm") == image);
  CHECK(read_bytes(folder / "a.ppm").substr(0, 12) == "P6\n11 5\n255\n");
}

TEST_CASE("PPM headers may have comments, other maxima and 16 bits") {
  const std::vector<std::uint8_t> expected = {255, 0, 170, 255};
  CHECK(load_ppm("P6 # a comment\n#another\n1 1\n3\n" + std::string("\3\0\2", 3)).rgba == expected);
  CHECK(load_ppm("P6 1 1 65535\n" + std::string("\xFF\xFF\0\0\xAA\xAA", 6)).rgba == expected);
}

TEST_CASE("what is wrong with a PPM is said") {
  CHECK_THROWS_WITH(load_ppm("P6\n2 2\n255\n" + std::string(11, 'x')), Contains("is truncated"));
  CHECK_THROWS_WITH(load_ppm("P6\n2"), Contains("is truncated"));
  CHECK_THROWS_WITH(load_ppm("P6\nwide 2 255\n"), Contains("damaged PPM header"));
  CHECK_THROWS_WITH(load_ppm("P6\n1 1 0\nxxx"), Contains("maximum outside"));
  CHECK_THROWS_WITH(load_ppm("P6\n1 1 70000\nxxxxxx"), Contains("maximum outside"));
  CHECK_THROWS_WITH(load_ppm("P6\n1 1 10\n\x05\x0b\x01"), Contains("over its own maximum"));
  CHECK_THROWS_WITH(load_ppm("P6\n99999 99999 255\n"), Contains("too large"));
  CHECK_THROWS_WITH(load_ppm("P6\n99999999999999999999 1 255\n"), Contains("too large"));
  CHECK_THROWS_WITH(load_ppm("P6\n0 7 255\n"), Contains("is empty"));
  CHECK_THROWS_WITH(load_ppm("P6\n10000 10000 255\n"), Contains("is truncated"));
}
