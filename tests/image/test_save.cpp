#include "picture_files.hpp"

#include <iterator>

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

auto files_in(const TemporaryFolder& folder) {
  return std::distance(fs::directory_iterator(folder.path()), {});
}

} // namespace

TEST_CASE("a new picture is opaque black and within the limits") {
  CHECK(Image(2, 1).rgba == std::vector<std::uint8_t>{0, 0, 0, 255, 0, 0, 0, 255});
  CHECK_THROWS_AS(Image(0, 1), InputError);
  CHECK_THROWS_AS(Image(1, -1), InputError);
  CHECK_THROWS_AS(Image(kMaxImageSide + 1, 1), InputError);
  CHECK_THROWS_AS(Image(kMaxImageSide, kMaxImageSide), InputError);
}

TEST_CASE("saving replaces a file and leaves nothing else behind") {
  const TemporaryFolder folder;
  save_image(folder / "a.PNG", asymmetric_image(4, 4));
  save_image(folder / "a.PNG", asymmetric_image(5, 5));
  CHECK(load_image(folder / "a.PNG").width == 5);
  CHECK(files_in(folder) == 1);
}

TEST_CASE("a link stays a link when its picture is replaced") {
  const TemporaryFolder folder;
  save_image(folder / "a.png", asymmetric_image(4, 4));
  fs::create_symlink("a.png", folder / "link.png");
  save_image(folder / "link.png", asymmetric_image(6, 6));
  CHECK(fs::is_symlink(folder / "link.png"));
  CHECK(load_image(folder / "a.png").width == 6);
}

TEST_CASE("a device is written to, not replaced") {
  const TemporaryFolder folder;
  fs::create_symlink("/dev/null", folder / "null.png");
  save_image(folder / "null.png", asymmetric_image(4, 4));
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("a full device is an error") {
  const TemporaryFolder folder;
  if (!fs::exists("/dev/full")) return;
  fs::create_symlink("/dev/full", folder / "full.png");
  fs::create_symlink("/dev/full", folder / "full.ppm");
  CHECK_THROWS_WITH(save_image(folder / "full.png", asymmetric_image(200, 200)),
                    Contains("cannot be written"));
  CHECK_THROWS_WITH(save_image(folder / "full.ppm", asymmetric_image(200, 200)),
                    Contains("cannot be written"));
}

TEST_CASE("where nothing can be written the error says so, before and after") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "folder.png");
  for (const std::string name : {"a.gif", "a", "missing/a.png", "folder.png"}) {
    CAPTURE(name);
    CHECK_THROWS_WITH(check_image_path(folder / name), Contains(name));
    CHECK_THROWS_WITH(save_image(folder / name, asymmetric_image(2, 2)), Contains(name));
  }
  CHECK_NOTHROW(check_image_path(folder / "a.png"));
  CHECK_NOTHROW(check_image_path("a.ppm"));
  CHECK(files_in(folder) == 1);
}

TEST_CASE("a picture whose pixels do not match its size is refused") {
  const TemporaryFolder folder;
  Image image = asymmetric_image(4, 4);
  image.width = 5;
  CHECK_THROWS_WITH(save_image(folder / "a.png", image), Contains("do not match"));
  CHECK_THROWS_WITH(save_image(folder / "a.png", Image()), Contains("is empty"));
  CHECK(files_in(folder) == 0);
}

TEST_CASE("only a regular file is loaded") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(load_image(folder / "a.png"), Contains("no such file"));
  CHECK_THROWS_WITH(load_image(folder.path()), Contains("is a folder"));
  CHECK_THROWS_WITH(load_image("/dev/null"), Contains("is not a regular file"));
}
