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
  // Transformations turn it; it does not move.
  CHECK(fog("up 3*y translate 5 scale 2").up.y == Approx(1));
  CHECK(error_line("fog { up 0 }") == "scene.pov:1:10: error: this vector has no direction");
  CHECK(fog("rotate 90*x").up.z == Approx(1));
  CHECK(parse("#declare F = fog { distance 3 } fog { F distance 4 } fog { F }").fogs.at(0).distance == 4);
  CHECK(parse("#declare F = fog { distance 3 } fog { F distance 4 } fog { F }").fogs.at(1).distance == 3);
  CHECK(error_line("fog { fog_type 3 }") == "scene.pov:1:16: error: there are fogs of type 1 and 2");
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
  const auto material = [](const std::string& modifiers) {
    const Scene scene = parse("sphere { 0, 1 " + modifiers + " }");
    return scene.materials.at(scene.objects.at(0).material);
  };
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
}
