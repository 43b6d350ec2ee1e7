// Scene files, include files and the scenes the project measures itself by.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using namespace celltrace;
namespace fs = std::filesystem;

namespace {

/// A folder that is gone when the test is over.
class Folder {
public:
  Folder() : path_(fs::temp_directory_path() / ("celltrace-pov-" + std::to_string(std::random_device{}()))) {
    fs::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }

  std::string write(const std::string& name, const std::string& text) const {
    const fs::path file = path_ / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }
  std::string path(const std::string& name) const { return (path_ / name).string(); }

private:
  fs::path path_;
};

std::string file_error(const std::string& path, const ParseOptions& options = {}) {
  try {
    parse_file(path, options);
  } catch (const SceneError& e) {
    return e.what();
  }
  return {};
}

std::string file_output(const std::string& path, ParseOptions options = {}) {
  std::string said;
  options.message = [&said](std::string_view message) { said += message; };
  parse_file(path, options);
  return said;
}

bool has_installed_includes() {
  return fs::exists("/usr/share/povray-3.7/include/colors.inc");
}

fs::path first_scenes() {
  if (const char* folder = std::getenv("CELLTRACE_SHARED_SCENES")) return folder;
  return fs::path(CELLTRACE_SOURCE_DIR) / "../shared/scenes/first";
}

} // namespace

TEST_CASE("files that cannot be scenes") {
  const Folder folder;
  CHECK(file_error(folder.path("none.pov")) ==
        folder.path("none.pov") + ":1:1: error: there is no such file");
  CHECK(file_error(folder.path("")) == folder.path("") + ":1:1: error: this is a directory, not a file");
  CHECK(file_error(folder.write("empty.pov", "")) ==
        folder.path("empty.pov") + ":1:1: error: the scene is empty");
  ParseOptions options;
  options.limits.file_bytes = 10;
  CHECK(file_error(folder.write("long.pov", "sphere { 0, 1 }"), options) ==
        folder.path("long.pov") + ":1:1: error: this file is larger than 10 bytes");
}

TEST_CASE("include files are searched for in order") {
  const Folder folder;
  const Folder library;
  folder.write("a.inc", "#debug \"near \" #include \"sub/b.inc\"");
  folder.write("sub/b.inc", "#debug \"b \" #include \"c.inc\"");
  folder.write("sub/c.inc", "#debug \"beside \"");
  folder.write("c.inc", "#debug \"scene \"");
  library.write("c.inc", "#debug \"library \"");
  library.write("only.inc", "#debug \"only \" #local L = 1;");
  ParseOptions options;
  options.library_paths = {library.path("")};
  const std::string scene =
      folder.write("scene.pov", "#include \"a.inc\" #include \"c.inc\" #include concat(\"on\", \"ly.inc\") "
                                "#ifdef (L) #debug \"leak\" #end");
  CHECK(file_output(scene, options) == "near b beside scene only ");
  CHECK(file_output(folder.write("case.pov", "#include \"SUB\\B.INC\""), options) == "b beside ");
}

TEST_CASE("include files that cannot be read") {
  const Folder folder;
  const std::string scene = folder.write("scene.pov", "\n#include \"a.inc\"");
  CHECK(file_error(scene) == scene + ":2:10: error: cannot find the include file 'a.inc'");
  const std::string include = folder.write("a.inc", "\n\n oops");
  CHECK(file_error(scene) ==
        include + ":3:2: error: 'oops' is not declared\n    included from " + scene + ":2");
  folder.write("a.inc", "#include \"a.inc\"");
  const std::string cyclic = file_error(scene);
  CHECK(cyclic.find("files are included more than 64 deep: does 'a.inc' include itself?") !=
        std::string::npos);
  CHECK(std::count(cyclic.begin(), cyclic.end(), '\n') < 12);
  folder.write("a.inc", "#if (1)");
  CHECK(file_error(scene).find("#end is missing for what starts here") != std::string::npos);
}

TEST_CASE("POV-Ray's include files parse whole") {
  if (!has_installed_includes()) {
    WARN("POV-Ray's include files are not installed: skipped");
    return;
  }
  for (const char* name :
       {"arrays", "chars",  "colors",  "consts", "debug",    "finish",     "functions", "glass",
        "golds",  "logo",   "math",    "metals", "rand",     "shapes",     "shapes3",   "skies",
        "stars",  "stones", "strings", "sunpos", "textures", "transforms", "woodmaps",  "woods"}) {
    INFO(name);
    CHECK_NOTHROW(test::parse("#include \"colors.inc\" #include \"" + std::string(name) + ".inc\""));
  }
  const Scene scene =
      test::parse("#include \"colors.inc\" #include \"textures.inc\" sphere { 0, 1 pigment { Red } }"
                  "background { SkyBlue }");
  CHECK(scene.materials.at(0).pigment.rgb == Vec3(1, 0, 0));
  CHECK(scene.background.z == Approx(0.8).margin(0.2));
  CHECK(scene.gamma_mode == GammaMode::assumed); // colors.inc executes #version
}

TEST_CASE("the first scenes have their shape") {
  const fs::path folder = first_scenes();
  if (!fs::exists(folder / "bunny.pov")) {
    WARN("the first scenes are not there: skipped");
    return;
  }
  struct Shape {
    const char* name;
    std::size_t objects;
    std::size_t triangles;
    std::size_t lights;
    bool needs_colors;
  };
  for (const Shape& shape :
       {Shape{"adufrene_reflection", 4, 0, 1, false}, Shape{"bunny", 3, 69632, 2, false},
        Shape{"crystal", 604, 0, 2, false}, Shape{"fabbricius_felbrigg1", 1, 0, 1, true},
        Shape{"forste_egg", 1, 0, 1, true}, Shape{"forste_eye", 1, 0, 1, true},
        Shape{"forste_first_box", 1, 12, 1, true}, Shape{"jncraton_dish", 1377, 402156, 1, true},
        Shape{"jncraton_rock", 2228, 396399, 0, true}, Shape{"magh_simplesphere", 1, 0, 1, true}}) {
    if (shape.needs_colors && !has_installed_includes()) continue;
    INFO(shape.name);
    const Scene scene = parse_file(folder / (std::string(shape.name) + ".pov"));
    CHECK(scene.objects.size() == shape.objects);
    CHECK(scene.lights.size() == shape.lights);
    std::size_t triangles = 0;
    for (const Object& object : scene.objects)
      if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape))
        triangles += (*mesh)->triangles.size();
    CHECK(triangles == shape.triangles);
    CHECK_NOTHROW(validate(scene));
  }
}
