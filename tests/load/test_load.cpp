// Scene files are read by the format that their extensions stand for.
#include "celltrace/error.hpp"
#include "celltrace/load.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace celltrace;
namespace fs = std::filesystem;

namespace {

/// A folder that is removed with all files in it.
class Folder {
public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "celltrace-load-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

private:
  fs::path path_;
};

} // namespace

TEST_CASE("Scenes are POV-Ray's whatever the extensions of their names are") {
  const Folder folder;
  for (const char* name : {"a.pov", "a.POV", "a.inc", "scene", "tmp123.xyz", ".pov", "a.", "a. "}) {
    INFO(name);
    const Scene scene = load_scene(folder.write(name, "sphere { 0, 1 } box { 0, 1 }"));
    CHECK(scene.objects.size() == 2);
  }
}

TEST_CASE("Loading a scene takes the options of parsing it, and throws its errors") {
  const Folder folder;
  ParseOptions options;
  options.clock = 3;
  const fs::path path = folder.write("a.pov", "#if (clock = 3) sphere { 0, 1 } #else sphere { #end");
  CHECK(load_scene(path, options).objects.size() == 1);
  CHECK_THROWS_AS(load_scene(path), SceneError);
  CHECK_THROWS_AS(load_scene(folder.write("b", "") / "none.pov"), InputError);
}
