// Scenes of the tests are read exactly as they were. What is expected stands with the render room's tests,
// which say how to renew it.
#include <bit>
#include <filesystem>
#include <fstream>
#include <string>

#include <catch2/catch.hpp>

#include "pov/parsing.hpp"
#include "render/image_bytes.hpp"

using namespace celltrace;
namespace fs = std::filesystem;

TEST_CASE("scenes of the tests are read as they were") {
  if (std::endian::native != std::endian::little) return; // images are others there
  const fs::path source = CELLTRACE_SOURCE_DIR;
  std::ifstream file(source / "tests/render/expected_scenes.txt");
  int count = 0;
  for (std::string pixels, image, counts, name; file >> pixels >> image >> counts >> name;) {
    if (!name.ends_with(".pov")) continue;
    fs::path path = source / "tests/scenes" / name;
    if (!fs::exists(path)) path = source / "examples/scenes" / name;
    ParseOptions options;
    options.message = [](std::string_view) {};
    CAPTURE(name);
    CHECK(test::hash_of(test::bytes_of(SceneImage(parse_file(path, options)))) == image);
    ++count;
  }
  CHECK(count > 40);
}
