// Kinds of light sources. What is expected was seen in POV-Ray's pictures.
#include "parsing.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <utility>

#include <glm/geometric.hpp>

using namespace celltrace;
using namespace celltrace::test;

namespace {

/// The only light of a scene.
Light light(const std::string& modifiers, const std::string& behind = "") {
  const Scene scene = parse("light_source { <0, 4, 0> rgb 1 " + modifiers + " } " + behind);
  REQUIRE(scene.lights.size() == 1);
  return scene.lights.front();
}

std::string refusal(const std::string& modifiers) {
  const std::string line = error_line("light_source { 0 rgb 1 " + modifiers + " }");
  const std::size_t words = line.find("error: ");
  return words == std::string::npos ? line : line.substr(words + 7);
}

} // namespace

TEST_CASE("a spotlight has POV-Ray's defaults, and a second spotlight restores them") {
  const Light plain = light("spotlight");
  CHECK(plain.kind == Light::Kind::spotlight);
  CHECK(plain.point_at == Vec3(0, 0, 1));
  CHECK(plain.radius == 30);
  CHECK(plain.falloff == 45);
  CHECK(plain.tightness == 0);
  CHECK_FALSE(plain.parallel);
  const Light full = light("spotlight point_at <1, 2, 3> radius 10 falloff 20 tightness 5");
  CHECK(full.point_at == Vec3(1, 2, 3));
  CHECK(full.radius == 10);
  CHECK(full.falloff == 20);
  CHECK(full.tightness == 5);
  // Said again, it begins anew.
  CHECK(light("spotlight radius 10 tightness 2 spotlight").radius == 30);
  CHECK(light("spotlight radius 10 tightness 2 spotlight").tightness == 0);
}

TEST_CASE("cylinders of light") {
  const Light plain = light("cylinder point_at 0");
  CHECK(plain.kind == Light::Kind::cylinder);
  CHECK(plain.radius == 0.75);
  CHECK(plain.falloff == 1);
  CHECK(light("cylinder radius 2 falloff 3 tightness 4").falloff == 3);
  const Light both = light("cylinder spotlight");
  CHECK(both.kind == Light::Kind::spotlight);
  CHECK(both.parallel);
}

TEST_CASE("parallel and fading light") {
  const Light parallel = light("parallel point_at x");
  CHECK(parallel.kind == Light::Kind::point);
  CHECK(parallel.parallel);
  CHECK(parallel.point_at == Vec3(1, 0, 0));
  CHECK(light("spotlight parallel").parallel);
  const Light fading = light("fade_distance 3 fade_power 1.5");
  CHECK(fading.fade_distance == 3);
  CHECK(fading.fade_power == 1.5);
  CHECK(light("fade_distance 3").fade_power == 0);
}

TEST_CASE("light through something") {
  const auto through = [](const std::string& modifiers) {
    const Light lit = light(modifiers);
    REQUIRE(lit.projected_through);
    return std::get<std::shared_ptr<const Csg>>(lit.projected_through->shape)->parts;
  };
  CHECK_FALSE(light("").projected_through);
  const auto moved =
      through("projected_through { sphere { 0, 1 pigment { rgb 1 } } translate x } translate y");
  REQUIRE(moved.size() == 1);
  CHECK(moved[0].transform.point(Vec3(0)) == Vec3(1, 1, 0));
  const auto parts =
      through("projected_through { union { box { 0, 1 } union { sphere { 0, 1 } light_source { 0 rgb 1 } } "
              "mesh { triangle { 0, x, y } } difference { box { 0, 1 } sphere { 0, 1 } } } scale 2 }");
  REQUIRE(parts.size() == 4);
  CHECK(std::holds_alternative<Sphere>(parts[1].shape));
  CHECK(std::holds_alternative<std::shared_ptr<const Mesh>>(parts[2].shape));
  const Scene scene = parse("light_source { y rgb 1 projected_through { sphere { 0, 1 } } }");
  CHECK(scene.objects.empty()); // it is not seen
  CHECK(scene.materials.empty());
  CHECK(through("projected_through { sphere { 0, 0 } }").empty()); // nothing shines through it
  CHECK(refusal("projected_through { sphere { 0, 1 } } projected_through { sphere { 0, 1 } }") ==
        "a light source is projected through one object only");
  CHECK(
      refusal(
          "projected_through { intersection { mesh { triangle { 0, x, y } inside_vector z } box { 0, 1 } } }")
          .starts_with("a mesh in CSG that a light is projected through is not supported"));
  CHECK(error_line("sphere { 0, 1 } object { projected_through { sphere { 0, 1 } } }") ==
        "scene.pov:1:26: error: only a light source is projected through something");
}

TEST_CASE("light that fog dims") {
  CHECK_FALSE(light("").is_dimmed_by_fog);
  CHECK(light("media_attenuation on").is_dimmed_by_fog);
  CHECK(light("media_attenuation").is_dimmed_by_fog);
  CHECK_FALSE(light("media_attenuation off").is_dimmed_by_fog);
  CHECK_FALSE(light("media_attenuation on media_interaction off").is_dimmed_by_fog);
}

TEST_CASE("lights with an area") {
  CHECK_FALSE(light("jitter adaptive 2").area);
  const Light plain = light("area_light <4, 1, 0>, <0, 0, 2>, 5, 3.9");
  REQUIRE(plain.area);
  CHECK(plain.area->across == Vec3(4, 1, 0));
  CHECK(plain.area->along == Vec3(0, 0, 2));
  CHECK(plain.area->columns == 5);
  CHECK(plain.area->rows == 3);
  CHECK(plain.area->adaptive == 100);
  CHECK_FALSE(plain.area->jitter);
  CHECK_FALSE(plain.area->circular);
  CHECK_FALSE(plain.area->orient);
  // In any order, and beside every kind.
  const Light full =
      light("jitter adaptive 1.7 area_light x y 2 3 spotlight circular orient area_illumination off");
  CHECK(full.kind == Light::Kind::spotlight);
  REQUIRE(full.area);
  CHECK(full.area->adaptive == 1);
  CHECK(full.area->jitter);
  CHECK(full.area->circular);
  CHECK(full.area->orient);
  CHECK(light("area_light x, y, 2, 2 adaptive -1").area->adaptive == 0);
  const Light moved = light("area_light 2*x, y, 2, 2 rotate 90*z translate x");
  CHECK(glm::length(moved.area->across - Vec3(0, 2, 0)) < 1e-12);
  CHECK(glm::length(moved.area->along - Vec3(-1, 0, 0)) < 1e-12);
  const Scene scene = parse("#declare L = light_source { 0 rgb 1 area_light x, y, 2, 2 scale 2 }"
                            "union { light_source { L scale 3 } scale 2 }");
  CHECK(scene.lights[0].area->across == Vec3(12, 0, 0));
}

TEST_CASE("lights that shine from all places of their area") {
  const auto lights = [](const std::string& text) {
    return parse("light_source { y rgb 12 spotlight point_at 0 " + text + " }").lights;
  };
  const std::vector<Light> grid = lights("area_light 4*x, 2*z, 3, 2 area_illumination adaptive 1");
  REQUIRE(grid.size() == 6);
  for (const Light& light : grid) {
    CHECK_FALSE(light.area);
    CHECK(light.colour == Vec3(2));
    CHECK(light.location - light.point_at == Vec3(0, 1, 0));
  }
  CHECK(grid[0].location == Vec3(-2, 1, -1));
  CHECK(grid[4].location == Vec3(0, 1, 1));
  CHECK(lights("parallel area_light 4*x, 2*z, 3, 2 area_illumination")[0].point_at == Vec3(0));
  const std::vector<Light> circle = lights("area_light 4*x, 4*z, 5, 5 circular area_illumination on");
  REQUIRE(circle.size() == 25);
  CHECK(glm::length(circle[0].location - Vec3(0, 1, 0)) == Approx(2));
  CHECK(circle[12].location == Vec3(0, 1, 0));
  CHECK(lights("area_light x, z, 200, 3 area_illumination").size() == 48);
  CHECK(lights("area_illumination area_light x, z, 1, 1").size() == 1);

  const Scene group = parse("light_group { light_source { y rgb 1 area_light x, z, 2, 2 area_illumination }"
                            " sphere { 0, 1 } }");
  CHECK(group.light_groups.at(0).lights.size() == 4);
  CHECK_FALSE(group.lights.at(3).is_global);
}

TEST_CASE("a shadowless light has no other kind") {
  CHECK(light("spotlight shadowless").kind == Light::Kind::point);
  CHECK(light("spotlight shadowless").shadowless);
  CHECK_FALSE(light("shadowless spotlight").shadowless);
  CHECK(light("cylinder shadowless").parallel);
  CHECK(light("shadowless fade_distance 2 fade_power 1").fade_power == 1);
}

TEST_CASE("a light moves with what it points at, as it is by then") {
  const Light moved = light("spotlight point_at x translate 2*z");
  CHECK(moved.location == Vec3(0, 4, 2));
  CHECK(moved.point_at == Vec3(1, 0, 2));
  CHECK(light("translate 2*z spotlight point_at x").point_at == Vec3(1, 0, 0));
  CHECK(light("translate 2*z spotlight").point_at == Vec3(0, 0, 3));
  CHECK(light("cylinder radius 2 falloff 3 scale 2").falloff == 3);
  const Scene scene = parse("#declare L = light_source { 4*y rgb 1 spotlight point_at x }"
                            "union { light_source { L translate y } object { L } translate 5*z }"
                            "#declare M = object { L translate y } light_source { M point_at 0 }");
  REQUIRE(scene.lights.size() == 3);
  CHECK(scene.lights[0].location == Vec3(0, 5, 5));
  CHECK(scene.lights[0].point_at == Vec3(1, 1, 5));
  CHECK(scene.lights[1].point_at == Vec3(1, 0, 5));
  CHECK(scene.lights[2].location == Vec3(0, 5, 0));
  CHECK(scene.lights[2].point_at == Vec3(0, 0, 0));
}

TEST_CASE("what a light looks like") {
  const Scene scene =
      parse("light_source { <0, 4, 0> rgb 1 translate x looks_like { sphere { 0, 1 scale 2 } } "
            "translate z }");
  REQUIRE(scene.lights.size() == 1);
  CHECK(scene.lights[0].location == Vec3(1, 4, 1));
  REQUIRE(scene.objects.size() == 1);
  CHECK(scene.objects[0].transform.point({1, 0, 0}) == Vec3(3, 4, 1));
  CHECK(scene.objects[0].no_shadow);
}

TEST_CASE("modifiers of what a light looks like apply to it where the light is") {
  const auto look = [](const std::string& modifiers) {
    const Scene scene = parse(
        "light_source { <2, 3, 0> rgb 1 looks_like { sphere { 0, 1 pigment { rgb x } } " + modifiers + " }");
    REQUIRE(scene.objects.size() == 1);
    CHECK(scene.lights.size() == 1);
    return std::pair{scene.objects[0], scene.materials[scene.objects[0].material]};
  };
  const auto middle = [&](const std::string& modifiers) {
    return look(modifiers).first.transform.point({0, 0, 0});
  };
  CHECK(middle("}") == Vec3(2, 3, 0));
  CHECK(middle("translate 2*x }") == Vec3(4, 3, 0));
  CHECK(middle("scale 2 }") == Vec3(4, 6, 0));
  CHECK(glm::length(middle("rotate 90*z }") - Vec3(-3, 2, 0)) < 1e-12);
  CHECK(middle("scale 2 } translate 2*x") == Vec3(6, 6, 0));
  CHECK(middle("scale 2 } scale .5") == Vec3(2, 3, 0));
  CHECK(look("pigment { rgb y } }").second.pigment.rgb == Vec3(0, 1, 0));
  CHECK(look("clipped_by { plane { x, 2 } } no_shadow }").first.clipped_by);
  const Scene before =
      parse("light_source { <2, 3, 0> rgb 1 translate -4*x looks_like { sphere { 0, 1 } scale 2 } "
            "rotate 90*z }");
  CHECK(glm::length(before.objects[0].transform.point({0, 0, 0}) - Vec3(-6, -4, 0)) < 1e-12);
}

TEST_CASE("what a light looks like belongs to unions, but to no other CSG") {
  const std::string lamp = "#declare L = light_source { 0 rgb 1 looks_like { sphere { 0, 1 } } } ";
  const Scene scene =
      parse(lamp + "union { light_source { L } sphere { 0, 2 } pigment { rgb .5 } translate y }");
  REQUIRE(scene.objects.size() == 2);
  CHECK(scene.objects[0].material == scene.objects[1].material);
  CHECK(scene.objects[0].no_shadow);
  CHECK_FALSE(scene.objects[1].no_shadow);
  CHECK(scene.objects[0].transform.point({0, 0, 0}) == Vec3(0, 1, 0));
  const Scene cut = parse(lamp + "intersection { light_source { L } sphere { 0, 2 } box { 0, 1 } }");
  CHECK(cut.lights.size() == 1);
  CHECK(cut.objects.size() == 1);
}

TEST_CASE("what light sources cannot have") {
  const std::string beam = "only a spotlight or cylinder has 'radius', 'falloff' and 'tightness'";
  CHECK(refusal("radius 3") == beam);
  CHECK(refusal("parallel tightness 3") == beam);
  CHECK(refusal("shadowless falloff 3") == beam);
  CHECK(refusal("point_at x") == "only a spotlight, cylinder or parallel light points at something");
  CHECK(refusal("point_at x parallel") == "only a spotlight, cylinder or parallel light points at something");
  CHECK(refusal("box") == "there is no light source of this shape");
  CHECK(refusal("looks_like { sphere { 0, 1 } } looks_like { sphere { 0, 2 } }") ==
        "a light source looks like one object only");
  CHECK(refusal("sphere { 0, 1 }") == "a light source consists of no objects");
  CHECK(refusal("looks_like { sphere { 0, 1 } sphere { 0, 2 } }") != "");
  CHECK(error_line("looks_like { sphere { 0, 1 } }") ==
        "scene.pov:1:1: error: only a light source looks like something");
  CHECK(refusal("looks_like { union { looks_like { sphere { 0, 1 } } } }") ==
        "only a light source looks like something or is projected through it");
  CHECK(refusal("area_light x, y, 0, 2") == "an area light has 1 to 256 places along each side");
  CHECK(refusal("area_light x, y, 2, 257") == "an area light has 1 to 256 places along each side");
  CHECK(refusal("area_light x, y, 1, 3 circular") ==
        "a circular area light has more than one place along each side");
  CHECK(refusal("area_illumination on area_light x, y, 2, 3 orient") ==
        "'area_illumination' of a light with 'orient' is not supported yet");
  CHECK(error_line("light_source { 0 rgb 1 spotlight radius x }") ==
        "scene.pov:1:41: error: expected a float, found a vector");
  CHECK(error_line("light_source { 0 rgb 1 looks_like { ovus { threshold 1 } } }") ==
        "scene.pov:1:37: error: 'ovus' is not supported yet");
}
