// Where in its text the objects of a scene come from.
#include "celltrace/pov.hpp"
#include "files.hpp"

#include <catch2/catch.hpp>

#include <sstream>

using namespace celltrace;

namespace {

/// A line for each object: its index, kind and name, where it is written, and where it is placed.
std::vector<std::string> origins_of(const std::string& text, ParseOptions options = {}) {
  std::vector<std::string> lines;
  options.places_object = [&](Index object, const ObjectOrigin& origin) {
    std::ostringstream line;
    line << object << ' ' << origin.kind << ' ' << (origin.name.empty() ? "-" : origin.name) << ' '
         << origin.file << ':' << origin.line << ':' << origin.column << ' ' << origin.placed_file << ':'
         << origin.placed_line;
    lines.push_back(line.str());
  };
  const Scene scene = parse_string(text, options, "s.pov");
  CHECK(lines.size() == scene.objects.size());
  return lines;
}

using Lines = std::vector<std::string>;

} // namespace

TEST_CASE("objects are told of with their kinds and places") {
  CHECK(origins_of("sphere { 0, 1 }\n  box { -1, 1 } plane { y, -1 }\n"
                   "triangle { 0, x, y }\nmesh { triangle { 0, x, y } }\n"
                   "difference { box { -1, 1 }\n sphere { 0, 1.2 } }\n"
                   "light_source { 10, 1 }\nmerge { sphere { 0, 1 } sphere { x, 1 } }") ==
        Lines{"0 sphere - s.pov:1:1 s.pov:1", "1 box - s.pov:2:3 s.pov:2", "2 plane - s.pov:2:17 s.pov:2",
              "3 triangle - s.pov:3:1 s.pov:3", "4 mesh - s.pov:4:1 s.pov:4",
              "5 difference - s.pov:5:1 s.pov:5", "6 merge - s.pov:8:1 s.pov:8"});
}

TEST_CASE("objects are told of with the names that they were declared with") {
  CHECK(origins_of("#declare Ball = sphere { 0, 1 }\n"
                   "Ball\n"
                   "object { Ball translate x }\n"
                   "#declare Pair = union {\n"
                   "  object { Ball }\n"
                   "  cone { 0, 1, y, 0 } }\n"
                   "object { Pair }\n"
                   "#local Other = Ball;\n"
                   "Other\n"
                   "#declare A = array[1] { sphere { 0, 2 } }\n"
                   "object { A[0] }") ==
        Lines{"0 sphere Ball s.pov:1:17 s.pov:2", "1 sphere Ball s.pov:3:1 s.pov:3",
              "2 sphere Ball s.pov:5:3 s.pov:7", "3 cone Pair s.pov:6:3 s.pov:7",
              "4 sphere Other s.pov:1:17 s.pov:9", "5 sphere - s.pov:11:1 s.pov:11"});
}

TEST_CASE("objects of macros and included files are told of by their own places") {
  ParseOptions options;
  options.file = [](const std::string& name) {
    return name == "a.inc" ? std::optional<std::string>("#declare Disk =\n disc { 0, y, 1 }\ntorus { 2, 1 }")
                           : std::nullopt;
  };
  CHECK(
      origins_of("#include \"a.inc\"\n#macro M(R)\n  sphere { 0, R }\n#end\nM(1)\nDisk", options) ==
      Lines{"0 torus - a.inc:3:1 a.inc:3", "1 sphere - s.pov:3:3 s.pov:3", "2 disc Disk a.inc:2:2 s.pov:6"});
}
