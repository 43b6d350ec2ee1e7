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

const fs::path kInstalledIncludes = "/usr/share/povray-3.7/include";

bool has_installed_includes() {
  return fs::exists(kInstalledIncludes / "colors.inc");
}

fs::path first_scenes() {
  if (const char* folder = std::getenv("CELLTRACE_SHARED_SCENES")) return folder;
  return fs::path(CELLTRACE_SOURCE_DIR) / "../shared/scenes/first";
}

} // namespace

TEST_CASE("files that cannot be scenes") {
  const Folder folder;
  CHECK(file_error(folder.path("none.pov")) == folder.path("none.pov") + ": error: there is no such file");
  CHECK(file_error(folder.path("")) == folder.path("") + ": error: this is a directory, not a file");
  ParseOptions options;
  options.limits.file_bytes = 10;
  CHECK(file_error(folder.write("long.pov", "sphere { 0, 1 }"), options) ==
        folder.path("long.pov") + ": error: this file is larger than 10 bytes");
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
  const std::string said = file_output(folder.write("case.pov", "#include \"SUB\\B.INC\""), options);
  CHECK(said.ends_with("b beside "));
  CHECK(said.find("case.pov:1:10: note: 'SUB\\B.INC' is found as '") != std::string::npos);
  const std::string asking =
      "#debug str(file_exists(\"c.inc\"), 0, 0) #debug str(file_exists(\"d.inc\"), 0, 0)";
  CHECK(file_output(folder.write("asking.pov", asking)) == "10");
}

TEST_CASE("a header is read before the scene") {
  const Folder folder;
  const Folder elsewhere;
  ParseOptions options;
  options.header =
      elsewhere.write("h.inc", "#declare A = 5; #local B = 1; #debug \"header \" #include \"i.inc\"");
  elsewhere.write("i.inc", "#debug \"included \"");
  options.readable_folders = {elsewhere.path("")};
  const std::string scene = folder.write("scene.pov", "#debug str(A, 0, 0) #ifdef (B) #debug \"leak\" #end");
  CHECK(file_output(scene, options) == "header included 5");
  options.header = elsewhere.write("wrong.inc", "\noops");
  CHECK(file_error(scene, options) == elsewhere.path("wrong.inc") +
                                          ":2:1: error: 'oops' is not declared\n    included from " + scene +
                                          ":1");
  options.header = elsewhere.path("none.inc");
  CHECK_THROWS_WITH(parse_file(scene, options),
                    Catch::StartsWith("header " + elsewhere.path("none.inc") + ": "));
}

TEST_CASE("a semicolon may follow the name of a file that ends with a declaration") {
  Folder folder;
  for (const char* text :
       {"#declare A = 1;", "#declare A = 1; // a comment\n", "#declare A = sphere { 0, 1 }"}) {
    INFO(text);
    folder.write("a.inc", text);
    CHECK(file_output(folder.write("scene.pov", "#include \"a.inc\"; #debug \"on\"")) == "on");
  }
  folder.write("a.inc", "#declare A = 1");
  CHECK(file_output(folder.write("scene.pov", "#include \"a.inc\"; #debug \"on\"")) == "on");
  CHECK(file_error(folder.write("scene.pov", "#include \"a.inc\" #debug \"on\""))
            .find("a.inc:1:10: error: 'A' needs a ';'") != std::string::npos);
  folder.write("a.inc", "sphere { 0, 1 }");
  const std::string scene = folder.write("scene.pov", "#include \"a.inc\";");
  CHECK(file_error(scene).find(":1:17: error: unexpected ';'") != std::string::npos);
}

TEST_CASE("include files that cannot be read") {
  const Folder folder;
  const std::string scene = folder.write("scene.pov", "\n#include \"a.inc\"");
  CHECK(file_error(scene).starts_with(scene +
                                      ":2:10: error: cannot find the include file 'a.inc'\n"
                                      "    looked for in '" +
                                      fs::path(folder.path("")).parent_path().string() + "'"));
  CHECK(file_error(scene).ends_with("; -L FOLDER adds a folder"));
  const std::string include = folder.write("a.inc", "\n\n oops");
  CHECK(file_error(scene) ==
        include + ":3:2: error: 'oops' is not declared\n    included from " + scene + ":2");
  folder.write("a.inc", "#include \"a.inc\"");
  const std::string cyclic = file_error(scene);
  CHECK(cyclic.find("does 'a.inc' include itself? Files are included more than 64 deep") !=
        std::string::npos);
  CHECK(std::count(cyclic.begin(), cyclic.end(), '\n') < 12);
  folder.write("a.inc", "#if (1)");
  CHECK(file_error(scene).find("#end is missing for what starts here") != std::string::npos);
}

TEST_CASE("a scene reads only where it may") {
  const Folder folder, elsewhere;
  const std::string secret = elsewhere.write("secret.inc", "#debug \"secret \"");
  const std::string refused =
      " lies outside of the scene's folder and the library path: --allow DIR lets the "
      "scene read what is in a folder";
  fs::create_symlink(secret, folder.path("link.inc"));
  fs::create_directory_symlink(elsewhere.path(""), folder.path("linked"));
  const std::string around =
      "../" + fs::path(elsewhere.path("")).parent_path().filename().string() + "/secret.inc";
  for (const std::string& name :
       {secret, std::string("link.inc"), std::string("linked/secret.inc"), std::string("LINK.INC"), around}) {
    INFO(name);
    const std::string scene = folder.write("scene.pov", "#include \"" + name + "\"");
    CHECK(file_error(scene) == scene + ":1:10: error: include file '" + name + "'" + refused);
    const std::string asking = folder.write("asking.pov", "#if (file_exists(\"" + name +
                                                              "\")) #debug \"yes\" #else #debug \"no\" #end "
                                                              "sphere { 0, 1 }");
    CHECK(file_output(asking) == "no");
    ParseOptions options;
    options.readable_folders = {elsewhere.path("")};
    CHECK(file_output(scene, options).ends_with("secret "));
    options.readable_folders.clear();
    options.library_paths = {elsewhere.path("")};
    CHECK(file_output(scene, options).ends_with("secret "));
  }
  ParseOptions options;
  options.readable_folders = {folder.path("none")};
  CHECK_THROWS_AS(parse_file(folder.write("scene.pov", "sphere { 0, 1 }"), options), InputError);
}

TEST_CASE("an error in the middle of a file is no end") {
  if (!fs::exists("/proc/self/mem")) {
    WARN("there is no /proc: skipped");
    return;
  }
  ParseOptions options;
  options.readable_folders = {"/proc"};
  CHECK(test::error_line("#include \"/proc/self/mem\"", options).find("this file cannot be read: ") !=
        std::string::npos);
  // A file whose size nobody says is read whole all the same.
  CHECK(test::error_line("#include \"/proc/self/status\"", options).find("'Name' is not declared") !=
        std::string::npos);
}

TEST_CASE("POV-Ray's include files parse whole") {
  if (!has_installed_includes()) {
    WARN("POV-Ray's include files are not installed: skipped");
    return;
  }
  for (const auto& entry : fs::directory_iterator(kInstalledIncludes)) {
    if (entry.path().extension() != ".inc") continue;
    INFO(entry.path());
    ParseOptions options;
    options.message = [](std::string_view) {};
    // Some count on others to have been included before.
    CHECK_NOTHROW(test::parse("#include \"colors.inc\" #include \"shapes.inc\" #include \"" +
                                  entry.path().filename().string() + "\"",
                              options));
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
