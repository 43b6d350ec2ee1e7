// Fog, what is hollow, and what only some rays see. What is expected was seen in POV-Ray's pictures.
#include "parsing.hpp"

#include <catch2/catch.hpp>

#include <string>

using namespace celltrace;
using namespace celltrace::test;

namespace {

Fog fog(const std::string& body) {
  const Scene scene = parse("fog { " + body + " }");
  REQUIRE(scene.fogs.size() == 1);
  return scene.fogs.front();
}

bool is_hollow(const Scene& scene, std::size_t object) {
  return scene.interiors.at(scene.objects.at(object).interior).hollow;
}

} // namespace

TEST_CASE("fog") {
  const Fog plain = fog("");
  CHECK(plain.distance == 0);
  CHECK_FALSE(plain.is_ground);
  CHECK(plain.up == Vec3(0, 1, 0));
  CHECK(plain.turbulence.amount == Vec3(0));
  CHECK(plain.turbulence_depth == 0.5);
  const Fog full =
      fog("fog_type 2 distance 20 color rgbft <.1, .2, .3, .4, .5> fog_offset 3 fog_alt 2 up <0, 0, 2> "
          "turbulence <1, 2, 3> turb_depth 0.7 octaves 3 omega 0.4 lambda 2.5");
  CHECK(full.is_ground);
  CHECK(full.distance == 20);
  CHECK(full.colour == Vec3(.1, .2, .3));
  CHECK(full.filter == .4);
  CHECK(full.transmit == .5);
  CHECK(full.offset == 3);
  CHECK(full.altitude == 2);
  CHECK(full.up == Vec3(0, 0, 1));
  CHECK(full.turbulence.amount == Vec3(1, 2, 3));
  CHECK(full.turbulence.octaves == 3);
  CHECK(full.turbulence.omega == .4);
  CHECK(full.turbulence.lambda == 2.5);
  CHECK(full.turbulence_depth == .7);
  for (const char* colour : {"color color rgb z", "colour color colour blue 1", "color color rgbf <0, 0, 1>"})
    CHECK(fog(colour).colour == Vec3(0, 0, 1));
  // Transformations turn it; it does not move.
  CHECK(fog("up 3*y translate 5 scale 2").up.y == Approx(1));
  for (const char* body : {"rgb <0, 0, 1> 11", "11 rgb <0, 0, 1>", "<0, 0, 1> 11", "11 colour red 0 blue 1",
                           "rgb <0, 0, 1> distance 2 (5 + 6)"}) {
    INFO(body);
    CHECK(fog(body).distance == 11);
    CHECK(fog(body).colour == Vec3(0, 0, 1));
  }
  CHECK(fog("rotate 90*x").up.z == Approx(1));
  CHECK(parse("#declare F = fog { distance 3 } fog { F distance 4 } fog { F }").fogs.at(0).distance == 4);
  CHECK(parse("#declare F = fog { distance 3 } fog { F distance 4 } fog { F }").fogs.at(1).distance == 3);
  for (const char* type : {"0", "1", "1.9", "3", "-1"})
    CHECK_FALSE(fog("fog_type " + std::string(type)).is_ground);
  CHECK(fog("fog_type 2.5").is_ground);
}

TEST_CASE("rainbows") {
  const std::string map = " color_map { [0 rgb x] [1 rgbft <0, 1, 0, .5, .25>] }";
  const auto rainbow = [&](const std::string& body) {
    const Scene scene = parse("rainbow { " + body + map + " }");
    REQUIRE(scene.rainbows.size() == 1);
    return scene.rainbows.front();
  };
  const Rainbow plain = rainbow("direction z");
  CHECK(plain.angle == 0);
  CHECK(plain.width == 0);
  CHECK(plain.distance == 1e7); // POV-Ray's farthest
  CHECK(plain.jitter == 0);
  CHECK(plain.up == Vec3(0, 1, 0));
  CHECK(plain.arc_angle > 20000); // that is none: POV-Ray's default is in radians
  CHECK(plain.falloff_angle > 20000);
  REQUIRE(plain.colours.size() == 2);
  CHECK(plain.colours[1].position == 1);
  CHECK(plain.colours[1].rgb == Vec3(0, 1, 0));
  CHECK(plain.colours[1].filter == .5);
  CHECK(plain.colours[1].transmit == .25);
  const Rainbow full = rainbow("direction <1, 2, 3> angle 42 width 5 distance 1e7 jitter .01 up <0, 0, 2> "
                               "arc_angle 120 falloff_angle 30");
  CHECK(full.direction == Vec3(1, 2, 3));
  CHECK(full.angle == 42);
  CHECK(full.width == 5);
  CHECK(full.distance == 1e7);
  CHECK(full.jitter == .01);
  CHECK(full.up == Vec3(0, 0, 2));
  CHECK(full.arc_angle == 120);
  CHECK(full.falloff_angle == 30);
  CHECK(parse("rainbow { direction z width 3 }").rainbows.empty()); // without colours there is none
  const Scene two =
      parse("#declare R = rainbow { direction z width 3" + map + " } rainbow { R width 4 } rainbow { R }");
  CHECK(two.rainbows.at(0).width == 4);
  CHECK(two.rainbows.at(1).width == 3);
  CHECK(error_line("rainbow { }") == "scene.pov:1:1: error: this rainbow's direction has no length");
  CHECK(error_line("rainbow { direction y }") ==
        "scene.pov:1:1: error: this rainbow's direction and 'up' are one line");
  CHECK(error_line("rainbow { direction z arc_angle 30 falloff_angle 40 }") ==
        "scene.pov:1:1: error: this rainbow's 'arc_angle' is less than its 'falloff_angle'");
  CHECK_NOTHROW(parse("rainbow { direction z arc_angle 30 }"));
  CHECK_THAT(error_line("rainbow { direction z rotate x }"), Catch::Contains("unexpected"));
}

TEST_CASE("hollow objects") {
  const Scene scene = parse("sphere { 0, 1 } sphere { 0, 1 hollow } sphere { 0, 1 hollow off } "
                            "union { sphere { 0, 1 } sphere { 0, 1 hollow off } hollow }");
  CHECK_FALSE(is_hollow(scene, 0));
  CHECK(is_hollow(scene, 1));
  CHECK_FALSE(is_hollow(scene, 2));
  CHECK(is_hollow(scene, 3));
  CHECK_FALSE(is_hollow(scene, 4));
}

TEST_CASE("what only some rays see") {
  const Scene scene = parse("sphere { 0, 1 } sphere { 0, 1 no_image } sphere { 0, 1 no_reflection } "
                            "union { sphere { 0, 1 } box { 0, 1 } no_image no_reflection }");
  CHECK_FALSE(scene.objects.at(0).no_image);
  CHECK_FALSE(scene.objects.at(0).no_reflection);
  CHECK(scene.objects.at(1).no_image);
  CHECK(scene.objects.at(2).no_reflection);
  CHECK(scene.objects.at(4).no_image);
  CHECK(scene.objects.at(4).no_reflection);
}

TEST_CASE("what looks different from inside") {
  CHECK_FALSE(material("texture { pigment { rgb 1 } }").inside);
  const Material both =
      material("texture { pigment { rgb x } } interior_texture { pigment { gradient x } translate 2*x }");
  CHECK(both.pigment.rgb == Vec3(1, 0, 0));
  REQUIRE(both.inside);
  CHECK(both.inside->pigment.map);
  const Material declared =
      material("material { texture { pigment { rgb x } } interior_texture { pigment { rgb y } } }");
  REQUIRE(declared.inside);
  CHECK(declared.inside->pigment.rgb == Vec3(0, 1, 0));
  const char* const alone =
      "scene.pov:1:1: error: an object with an 'interior_texture' has to have a texture, too";
  CHECK(error_line("sphere { 0, 1 interior_texture { pigment { rgb x } } }") == alone);
  CHECK(error_line("sphere { 0, 1 material { interior_texture { pigment { rgb x } } } }") == alone);
  CHECK(
      error_line("#default { pigment { rgb y } }\nsphere { 0, 1 interior_texture { pigment { rgb x } } }") ==
      "scene.pov:2:1: error: an object with an 'interior_texture' has to have a texture, too");
}
