// What the language was before version 3.5, as far as POV-Ray 3.7 still reads it.
#include "parsing.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;

namespace {

Material old_texture(const std::string& parts, const std::string& version = "2.0") {
  return material("texture { " + parts + " }", "#version " + version + " ");
}

} // namespace

TEST_CASE("before version 1.5 a sign begins a number of its own") {
  const auto centre = [](const std::string& text) {
    return std::get<Sphere>(parse(text).objects.at(0).shape).centre;
  };
  CHECK(centre("#version 1.0 sphere { <0 1 -5> 1 }") == Vec3(0, 1, -5));
  CHECK(centre("#version 1.0 sphere { <-1 +2 -3>, 1 }") == Vec3(-1, 2, -3));
  CHECK(centre("#version 1.49 sphere { <0 (1 -5) 2> 1 }") == Vec3(0, -4, 2));
  CHECK(centre("#version 1.0 #declare A = 2 sphere { <0 A -A> 1 }") == Vec3(0, 2, -2));
  CHECK(centre("#version 1.0 #macro M() sphere { <0 1 -5> 1 } #end M()") == Vec3(0, 1, -5));
  CHECK(centre("#version 1.5 sphere { <0 1 -5 2> 1 }") == Vec3(0, -4, 2));
  CHECK(centre("#version 1.0 #declare A = 3 - 1 sphere { <A 0 0> 1 }") == Vec3(2, 0, 0));
  const auto plane = std::get<Plane>(parse("#version 1.0 plane { <0 1 0> -2 }").objects.at(0).shape);
  CHECK(plane.distance == -2);
}

TEST_CASE("before version 3.0 a texture has the parts of its pigment") {
  CHECK(old_texture("color red 1 green 0.5").pigment.rgb == Vec3(1, 0.5, 0));
  CHECK(old_texture("color red 1 alpha 0.5").pigment.filter == 0.5);
  CHECK(old_texture("color red 1 color green 1").pigment.rgb == Vec3(0, 1, 0));
  const std::string map = "color_map { [0 color red 1] [0.5 color green 1] }";
  for (const std::string& parts : {"bozo turbulence 2 " + map, map + " turbulence 2 bozo"}) {
    INFO(parts);
    const Pigment pigment = old_texture(parts).pigment;
    REQUIRE(pigment.map);
    CHECK(std::holds_alternative<pattern::Bozo>(pigment.map->pattern.kind));
    CHECK(pigment.map->pattern.turbulence.amount == Vec3(2));
    CHECK(pigment.map->entries.at(1).position == 0.5);
  }
  CHECK(old_texture("marble " + map).pigment.map->pattern.wave == Pattern::Wave::ramp);
  CHECK(old_texture("checker color red 1 color green 1").pigment.map->entries.size() == 2);
  CHECK(std::get<pattern::Gradient>(old_texture("gradient <0 1 0> " + map).pigment.map->pattern.kind)
            .direction == Vec3(0, 1, 0));
  CHECK(error_line("#version 3.0 sphere { 0, 1 texture { color red 1 } }") ==
        "scene.pov:1:38: error: unexpected 'color', expected '}'");
}

TEST_CASE("before version 3.0 a texture has the parts of its normal and finish") {
  const Material bumps = old_texture("color red 1 bumps 0.3 scale <2 2 2>");
  REQUIRE(bumps.normal);
  CHECK(bumps.normal->amount == 0.3);
  CHECK(std::holds_alternative<pattern::Bumps>(bumps.normal->pattern.kind));
  CHECK(bumps.normal->pattern.space.size() == 1);
  const Material waves = old_texture("marble ripples 0.5 frequency 3 phase 0.2");
  CHECK(waves.normal->pattern.frequency == 3);
  CHECK(waves.normal->pattern.phase == 0.2);
  CHECK(waves.pigment.map->pattern.frequency == 1);
  const Finish finish =
      old_texture("color red 1 ambient 0.2 diffuse 0.3 phong 0.4 phong_size 5 specular 0.6 roughness 0.7 "
                  "brilliance 8 reflection 0.9 metallic crand 0.1")
          .finish;
  CHECK(finish.ambient == Vec3(0.2));
  CHECK(finish.diffuse == 0.3);
  CHECK(finish.phong == 0.4);
  CHECK(finish.phong_size == 5);
  CHECK(finish.specular == 0.6);
  CHECK(finish.roughness == 0.7);
  CHECK(finish.brilliance == 8);
  CHECK(finish.reflection_max == Vec3(0.9));
  CHECK(finish.metallic == 1);
  CHECK(finish.crand == 0.1);
  CHECK(old_texture("0.05 color red 1").finish.crand == 0.05);
  const Scene glass =
      parse("#version 2.0 sphere { 0, 1 texture { color red 1 alpha 1 refraction 1 ior 1.5 } }");
  CHECK(glass.interiors.at(glass.objects.at(0).interior).ior == 1.5);
}

TEST_CASE("textures of before version 3.0 build on others") {
  const std::string named = "#version 2.0 #declare T = texture { color red 1 phong 1 } ";
  const Material changed = material("texture { T ambient 0.5 }", named);
  CHECK(changed.pigment.rgb == Vec3(1, 0, 0));
  CHECK(changed.finish.phong == 1);
  CHECK(changed.finish.ambient == Vec3(0.5));
  CHECK(material("texture { pigment { color green 1 } ambient 0.5 }", named).pigment.rgb == Vec3(0, 1, 0));
  CHECK(material("texture { color blue 1 }", "#version 2.0 default { texture { ambient 0.7 } } ")
            .finish.ambient == Vec3(0.7));
  CHECK(material("texture { tiles { texture { color red 1 } tile2 texture { color green 1 } } }", named).map);
}

TEST_CASE("before version 3.5 a camera that is told to look where it is goes on looking ahead") {
  const Scene scene = parse("#version 2.0 camera { look_at <0, 0, 0> location <0, 2, -6> }");
  CHECK(scene.camera.direction == Vec3(0, 0, 1));
  CHECK(scene.camera.location == Vec3(0, 2, -6));
}

TEST_CASE("a colour_map is a list of checkers' colours before version 3.0") {
  const auto colours = [](const std::string& texture) {
    return parse("#version 2.0 object { sphere { <0 0 0> 1 } texture { " + texture + " } }")
        .materials.back()
        .pigment.map->entries;
  };
  const std::string map =
      " color_map { [0 0.5 color red 1 color green 1] [0.5 1.5 color blue 1 color red 1] }";
  const auto checker = colours("checker" + map);
  REQUIRE(checker.size() == 2);
  CHECK(checker[0].value.rgb == Vec3(1, 0, 0));
  CHECK(checker[1].value.rgb == Vec3(0.5, 0, 0.5));
  REQUIRE(colours("hexagon" + map).size() == 3);
  CHECK(colours("hexagon" + map)[2].value.rgb == Vec3(1, 0, 0));
}
