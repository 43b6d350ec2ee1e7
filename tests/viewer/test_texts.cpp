// What the viewer writes: cameras, names of objects, and lines that fit.
#include "celltrace/pov.hpp"
#include "viewer/camera_text.hpp"
#include "viewer/information.hpp"
#include "viewer/object_names.hpp"
#include "viewer/text_layout.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace celltrace;
using namespace celltrace::viewer;

TEST_CASE("A scene with a camera's text has this camera") {
  const char* const cameras[] = {"location <1, 2, -3.3> look_at <0.1, 0.7, 0> angle 33",
                                 "location <1, 2, -3> right -1.5*x up y*1.1 look_at 2*y rotate <3, 4, 5>",
                                 "orthographic location -5*z look_at 0 angle 20",
                                 "orthographic location -5*z up 3*y right 4*x look_at <1, 1, 1>",
                                 "spherical angle 200, 70 location y",
                                 "fisheye angle 170 location y look_at <1, 2, 3>",
                                 "ultra_wide_angle angle 110 look_at x",
                                 "omnimax location x",
                                 "panoramic right 2*x direction 0.7*z",
                                 "cylinder 1 angle 100",
                                 "cylinder 4 angle 100 up 2*y"};
  for (const char* written : cameras)
    for (const char* version : {"", "#version 3.7; ", "#version 3.1; "}) {
      CAPTURE(written, version);
      const std::string begin = std::string(version);
      const Camera a = parse_string(begin + "camera { " + written + " }").camera;
      const std::string text = camera_text(a, 320, 240);
      CAPTURE(text);
      const Camera b = parse_string(begin + text).camera;
      CHECK(a.kind == b.kind);
      CHECK(a.location == b.location);
      CHECK(a.direction == b.direction);
      CHECK(a.right == b.right);
      CHECK(a.up == b.up);
      if (a.kind != Camera::Kind::perspective && a.kind != Camera::Kind::orthographic) {
        CHECK(a.angle == b.angle);
        CHECK(a.vertical_angle == b.vertical_angle);
      }
    }
}

TEST_CASE("Objects are called by their kind, name and place") {
  ObjectNames names;
  ParseOptions options;
  options.places_object = [&](Index object, const ObjectOrigin& origin) { names.add(object, origin); };
  options.file = [](const std::string& name) {
    return name == "a.inc" ? std::optional<std::string>("\n#declare Ball = sphere { 0, 1 }") : std::nullopt;
  };
  parse_string("#include \"a.inc\"\nbox { 0, 1 }\nBall\nobject { Ball translate x }", options,
               "folder/s.pov");
  CHECK(names.describe(0) == "box at s.pov:2");
  CHECK(names.describe(1) == "sphere 'Ball' at a.inc:2, placed at s.pov:3");
  CHECK(names.describe(2) == "sphere 'Ball' at s.pov:4");
  CHECK(names.describe(3) == "object 3");
}

TEST_CASE("Text is broken between words") {
  using Lines = std::vector<std::string>;
  CHECK(wrapped("one two three", 20) == Lines{"one two three"});
  CHECK(wrapped("one two three", 8) == Lines{"one two", "three"});
  CHECK(wrapped("one two three", 8, 2) == Lines{"one two", "  three"});
  CHECK(wrapped("first\nsecond line", 6) == Lines{"first", "second", "line"});
  CHECK(wrapped("abcdefghij", 4) == Lines{"abcd", "efgh", "ij"});
  CHECK(wrapped("    in a macro", 30) == Lines{"    in a macro"});
  CHECK(wrapped("äöüß äöü", 4) == Lines{"äöüß", "äöü"});
  CHECK(wrapped("a\n\nb", 9) == Lines{"a", "", "b"});
}

TEST_CASE("Help fits into windows of any size") {
  for (const int columns : {16, 23, 40, 78, 200})
    for (const int rows : {1, 3, 7, 20, 60}) {
      CAPTURE(columns, rows);
      std::string all;
      for (const auto& page : pages_of(help_table(), columns, rows)) {
        CHECK(page.size() <= static_cast<std::size_t>(std::max(rows, 2)));
        for (const std::string& line : page) {
          CHECK(line.size() <= static_cast<std::size_t>(columns));
          all += line + ' ';
        }
      }
      all.erase(std::remove(all.begin(), all.end(), ' '), all.end());
      if (columns < 78) continue;
      for (const auto& [what, about] : help_table()) {
        std::string letters = what + about;
        letters.erase(std::remove(letters.begin(), letters.end(), ' '), letters.end());
        CHECK(all.find(letters) != std::string::npos);
      }
    }
  CHECK(pages_of(help_table(), 100, 40).size() == 1);
}

TEST_CASE("Help has the mouse") {
  const auto table = help_table();
  for (const char* what : {"Click", "Left drag", "Right drag"})
    CHECK(std::any_of(table.begin(), table.end(), [&](const auto& row) { return row.first == what; }));
}

TEST_CASE("A picture at rest is still and not slow") {
  Frame frame;
  Situation situation;
  situation.frames_per_second = 1;
  const auto has = [&](const std::string& what) {
    const auto lines = information_on(frame, situation);
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return line.find(what) != std::string::npos; });
  };
  CHECK(has("1.0 frames/s"));
  situation.is_still = true;
  CHECK(!has("frames/s"));
  CHECK(has("still"));
}
