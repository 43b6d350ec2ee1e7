// Which lights shine on which objects. What is expected was seen in POV-Ray's pictures.
#include "parsing.hpp"

#include <catch2/catch.hpp>

#include <string>

using namespace celltrace;
using namespace celltrace::test;

namespace {

/// The red parts of the colours of the lights that shine on an object, as tenths, from the largest to the
/// smallest: lights of these tests are red by different amounts.
std::string lights_of(const Scene& scene, std::size_t object) {
  const Index number = scene.objects.at(object).light_group;
  std::vector<Index> lights;
  bool global = true;
  if (number != kNoIndex) {
    lights = scene.light_groups.at(number).lights;
    global = scene.light_groups.at(number).global_lights;
  }
  std::string names;
  for (Index light = 0; light < scene.lights.size(); ++light) {
    const bool is_listed = std::find(lights.begin(), lights.end(), light) != lights.end();
    CHECK_FALSE((is_listed && scene.lights[light].is_global));
    if (is_listed || (global && scene.lights[light].is_global))
      names += std::to_string(std::lround(scene.lights[light].colour.r * 10));
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string light(int tenths, const std::string& more = "") {
  return "light_source { y*9 rgb <" + std::to_string(tenths) + "/10, 0, 0> " + more + "} ";
}

/// lights_of() all objects of a scene, one after the other.
std::string lit(const std::string& text) {
  const Scene scene = parse(text);
  std::string all;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (i != 0) all += ' ';
    all += lights_of(scene, i);
  }
  return all;
}

const std::string kBall = "sphere { 0, 1 } ";

} // namespace

TEST_CASE("Lights of a group shine on its objects alone") {
  CHECK(lit(light(1) + kBall + "light_group { " + light(2) + kBall + "} " + kBall) == "1 2 1");
  CHECK(lit(light(1) + "light_group { " + kBall + light(2) + light(3) + "}") == "23");
  CHECK(lit(light(1) + "light_group { " + light(2) + kBall + "global_lights on }") == "12");
  CHECK(lit(light(1) + "light_group { " + light(2) + kBall + "global_lights }") == "12");
  CHECK(lit(light(1) + "light_group { " + light(2) + kBall + "global_lights on global_lights off }") == "2");
  CHECK(lit(light(1) + "light_group { " + kBall + "}") == "");
  CHECK(lit(light(1) + "light_group { " + light(2) + "} " + kBall) == "1");
}

TEST_CASE("Lights that are no parts of the group itself are global") {
  CHECK(lit(light(1) + "light_group { " + light(2) + "union { " + light(3) + kBall + "} } " + kBall) ==
        "2 13");
  CHECK(lit(light(1) + "light_group { " + light(2) + "merge { " + light(3) + kBall + kBall + "} } " +
            kBall) == "2 13");
  CHECK(lit("#declare L = " + light(2) + "; light_group { object { L } " + kBall + "} " + kBall) == "2 ");
}

TEST_CASE("Groups in groups") {
  const std::string inner = "light_group { " + light(3) + kBall + "} ";
  CHECK(lit(light(1) + "light_group { " + light(2) + kBall + inner + "}") == "2 3");
  CHECK(lit(light(1) + "light_group { " + inner + light(2) + kBall + "}") == "3 2");
  CHECK(lit(light(1) + "light_group { " + light(2) + kBall + inner + "global_lights on }") == "12 13");
  CHECK(lit(light(1) + "light_group { " + light(2) + "light_group { " + kBall + "global_lights on } }") ==
        "2");
  // Of what has a name POV-Ray makes copies, and gives these the lights around them as well.
  CHECK(lit("#declare G = " + inner + "; light_group { " + light(2) + kBall + "object { G } }") == "2 23");
  CHECK(lit("#declare G = light_group { " + light(2) + kBall + inner + "}; object { G }") == "2 23");
  CHECK(lit("#declare G = " + inner + "; light_group { " + light(2) + "union { G } } object { G }") ==
        "23 3");
  CHECK(lit(light(1) + "union { light_group { " + light(2) + kBall + "} " + kBall + "}") == "2 1");
}

TEST_CASE("What a light of a group looks like is lit by global lights, too") {
  const std::string look = "looks_like { " + kBall + "} ";
  CHECK(lit(light(1) + "light_group { " + light(2, look) + light(3) + kBall + "}") == "123 23");
}

TEST_CASE("Parts of CSG in a group, and groups in CSG") {
  const Scene scene = parse(light(1) + "light_group { " + light(2) + "difference { " + kBall +
                            "box { 0, 1 } } translate x }");
  REQUIRE(scene.objects.size() == 1);
  const auto& csg = std::get<std::shared_ptr<const Csg>>(scene.objects[0].shape);
  REQUIRE(csg->parts.size() == 2);
  CHECK(csg->parts[0].light_group == csg->parts[1].light_group);
  CHECK(scene.light_groups.at(csg->parts[0].light_group).lights == std::vector<Index>{1});
  CHECK(scene.lights[1].location == Vec3(1, 9, 0));
  const Scene cut = parse("difference { light_group { " + light(2) + kBall + "} box { 0, 1 } }");
  const auto& parts = std::get<std::shared_ptr<const Csg>>(cut.objects[0].shape)->parts;
  REQUIRE(parts.size() == 2);
  const auto& group = std::get<std::shared_ptr<const Csg>>(parts[0].shape)->parts;
  REQUIRE(group.size() == 1);
  CHECK(cut.light_groups.at(group[0].light_group).lights == std::vector<Index>{0});
  CHECK(parts[1].light_group == kNoIndex);
}

TEST_CASE("A light group has no texture and the like of its own") {
  CHECK_THAT(error_line("light_group { " + kBall + "pigment { rgb 1 } }"), Catch::Contains("unexpected"));
  CHECK_THAT(error_line("light_group { " + kBall + "inverse }"), Catch::Contains("unexpected"));
  CHECK_THAT(error_line("light_group { global_lights on " + kBall + "}"), Catch::Contains("unexpected"));
  CHECK_THAT(error_line("sphere { 0, 1 global_lights on }"), Catch::Contains("unexpected"));
  const std::string many = "#for (I, 1, 1100) light_group { " + kBall + "} #end";
  CHECK_THAT(error_line(many), Catch::Contains("more than 255 light groups"));
}
