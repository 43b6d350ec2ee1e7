// Patterns, their maps and lists, normals, layers, and how objects move them.
#include <catch2/catch.hpp>

#include <filesystem>

#include "pov/parsing.hpp"

using namespace celltrace;
using test::error_line;
using test::material;
using test::parse;

namespace {

PatternMap<Pigment> pigment_map(const std::string& items, const std::string& before = "") {
  const Material m = material("pigment { " + items + " }", before);
  REQUIRE(m.pigment.map);
  return *m.pigment.map;
}

Pattern pattern_of(const std::string& items) {
  return pigment_map(items).pattern;
}

template <class Kind> Kind kind(const std::string& items) {
  return std::get<Kind>(pattern_of(items).kind);
}

Normal normal(const std::string& items, const std::string& before = "") {
  const Material m = material("normal { " + items + " }", before);
  REQUIRE(m.normal);
  return *m.normal;
}

const Transform& transform(const std::vector<SpaceStep>& space, std::size_t step = 0) {
  return std::get<Transform>(space.at(step));
}

/// Where the pattern's origin is in the scene.
Vec3 origin(const std::vector<SpaceStep>& space) {
  return space.empty() ? Vec3(0) : transform(space).point(Vec3(0));
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i)
    result += text;
  return result;
}

} // namespace

TEST_CASE("every pattern has its word") {
  using namespace pattern;
  const std::pair<const char*, Kind> words[] = {
      {"agate", Agate{}},
      {"boxed", Boxed{}},
      {"bozo", Bozo{}},
      {"brick", Brick{}},
      {"bumps", Bumps{}},
      {"cells", Cells{}},
      {"checker", Checker{}},
      {"crackle", Crackle{}},
      {"cubic", Cubic{}},
      {"dents", Dents{}},
      {"gradient y", Gradient{}},
      {"granite", Granite{}},
      {"hexagon", Hexagon{}},
      {"leopard", Leopard{}},
      {"marble", Marble{}},
      {"onion", Onion{}},
      {"planar", Planar{}},
      {"quilted", Quilted{}},
      {"radial", Radial{}},
      {"ripples", Ripples{}},
      {"spherical", Spherical{}},
      {"square", Square{}},
      {"spiral1 3", Spiral{}},
      {"triangular", Triangular{}},
      {"spotted", Bozo{}},
      {"cylindrical", Cylindrical{}},
      {"waves", Waves{}},
      {"wood", Wood{}},
      {"wrinkles", Wrinkles{}},
      {"spiral2 3", Spiral{}},
      {"slope y", Slope{}},
      {"slope { x }", Slope{}},
      {"mandel 5", Fractal{}},
      {"julia <0, 1>, 5", Fractal{}},
      {"julia u 5", Fractal{}},
      {"magnet 1 mandel 5", Fractal{}},
      {"object { sphere { 0, 1 } }", Inside{}},
      {"pigment_pattern { wood }", Grey{}},
  };
  for (const auto& [word, kind] : words) {
    INFO(word);
    CHECK(pattern_of(word).kind.index() == kind.index());
    CHECK(normal(std::string(word) + ", 0.25").pattern.kind.index() == kind.index());
    CHECK(normal(std::string(word) + " 0.25").amount == 0.25);
  }
}

TEST_CASE("what stands behind a pattern's word") {
  using namespace pattern;
  CHECK(kind<Gradient>("gradient <1, 2, 3>").direction == Vec3(1, 2, 3));
  CHECK(kind<Spiral>("spiral1 3.7").arms == 3);
  CHECK_FALSE(kind<Spiral>("spiral1 3").is_crossed);
  CHECK(kind<Spiral>("spiral2 -2").arms == -2);
  CHECK(kind<Spiral>("spiral1 1000000").arms == 1000000);
  CHECK(kind<Spiral>("spiral2 2").is_crossed);
  CHECK(kind<Agate>("agate agate_turb 0.3").turbulence == 0.3);
  const Brick brick = kind<Brick>("brick rgb 1, rgb 0 brick_size <1, 2, 3> mortar 0.25");
  CHECK(brick.size == Vec3(1, 2, 3));
  CHECK(brick.mortar == 0.25);
  const Quilted quilted = kind<Quilted>("quilted control0 0.25 control1 2");
  CHECK(quilted.control[0] == 0.25);
  CHECK(quilted.control[1] == 2);
  CHECK(pattern_of("quilted").frequency == 0);
  CHECK(pattern_of("quilted frequency 2").frequency == 2);
  CHECK(pattern_of("boxed").frequency == 1);
  const Crackle crackle = kind<Crackle>("crackle form <1, 2, 3> metric 1 offset 0.5 solid");
  CHECK(crackle.form[2] == 3);
  CHECK(crackle.metric == 1);
  CHECK(crackle.offset == 0.5);
  CHECK(crackle.is_solid);
  const Fractal julia = kind<Fractal>("julia <0.25, 0.5>, 30 exponent 3 exterior 2, 0.1 interior 3 0.7");
  CHECK(julia.is_julia);
  CHECK(julia.c[1] == 0.5);
  CHECK(julia.iterations == 30);
  CHECK(julia.exponent == 3);
  CHECK(julia.exterior == 2);
  CHECK(julia.exterior_factor == 0.1);
  CHECK(julia.interior == 3);
  CHECK(julia.interior_factor == 0.7);
  CHECK(kind<Fractal>("magnet 2 mandel 7").magnet == 2);
  CHECK_FALSE(kind<Fractal>("magnet 2 mandel 7").is_julia);
  CHECK(kind<Fractal>("magnet 1 julia <1, 2>, 7").c[0] == 1);
  CHECK(std::get<Facets>(normal("facets coords 0.3").pattern.kind).coords == 0.3);
  CHECK(std::get<Facets>(normal("facets size 0.2").pattern.kind).size == 0.2);
  CHECK(error_line("sphere { 0, 1 pigment { bozo exterior 1, 2 } }") ==
        "scene.pov:1:30: error: this word means something to fractals only");
  CHECK(error_line("sphere { 0, 1 pigment { mandel 5 exterior 9, 2 } }") ==
        "scene.pov:1:34: error: this number must lie between 0 and 8");
  CHECK(error_line("sphere { 0, 1 pigment { magnet 3 mandel 5 } }") ==
        "scene.pov:1:34: error: a magnet is of kind 1 or 2");
  CHECK(error_line("sphere { 0, 1 pigment { bozo mortar 1 } }") ==
        "scene.pov:1:30: error: 'mortar' means nothing to this pattern");
  for (const char* arms : {"1e300", "1000001", "-1000001"})
    CHECK(error_line("sphere { 0, 1 pigment { spiral1 " + std::string(arms) + " } }") ==
          "scene.pov:1:33: error: a spiral has no more than a million arms");
}

TEST_CASE("slopes") {
  const auto slope = [](const std::string& items) { return kind<pattern::Slope>("slope { " + items + " }"); };
  const auto plain = slope("<1, 2, 3>");
  CHECK(plain.direction == Vec3(1, 2, 3));
  CHECK(plain.least == 0);
  CHECK(plain.most == 1);
  CHECK(plain.altitude == Vec3(0));
  const auto ranged = slope("y, 0.2, 0.7 altitude 2*x, -1, 3");
  CHECK(ranged.least == 0.2);
  CHECK(ranged.most == 0.7);
  CHECK(ranged.altitude == Vec3(2, 0, 0));
  CHECK(ranged.lowest == -1);
  CHECK(ranged.highest == 3);
  CHECK(slope("y 0.2 0.7, altitude x").most == 0.7);
  CHECK(slope("0 altitude x").direction == Vec3(0));
  CHECK(slope("y, 0.5, 0.5").most == 1); // no range
  CHECK(slope("y, 0.5").most == 0);
  CHECK_THAT(error_line("sphere { 0, 1 pigment { slope 0 } }"), Catch::Contains("neither"));
  CHECK_THAT(error_line("sky_sphere { pigment { slope y } }"), Catch::Contains("no surface"));
}

TEST_CASE("pigments as patterns") {
  const auto grey = kind<pattern::Grey>("pigment_pattern { checker rgb 1, rgb 0 scale 2 } scale 3");
  REQUIRE(grey.of->map);
  CHECK(grey.of->map->entries.size() == 2);
  CHECK(grey.of->map->pattern.space.size() == 1);
  CHECK(kind<pattern::Grey>("pigment_pattern { rgb 0.25 }").of->rgb == Vec3(0.25));
  CHECK(pigment_map("pigment_pattern { bozo }").entries.at(1).value.rgb == Vec3(1));
  CHECK(pigment_map("pigment_pattern { P } color_map { [0 rgb 0] [0.5 rgb 1] [1 rgb 0] }",
                    "#declare P = pigment { agate } ")
            .entries.size() == 3);
  std::string nest = "pigment_map { [0 pigment_pattern { bozo pigment_map { [0 bozo] } } ] }";
  for (int depth = 3; depth < kDeepestMap; ++depth)
    nest = "pigment_map { [0 bozo " + nest + " ] }";
  CHECK_THAT(error_line("sphere { 0, 1 pigment { bozo pigment_map { [0 bozo " + nest + " ] } } }"),
             Catch::Contains("nested"));
  CHECK_THAT(error_line("sky_sphere { pigment { pigment_pattern { slope y } } }"),
             Catch::Contains("no surface"));
}

TEST_CASE("insides of objects as patterns") {
  const auto plain = pigment_map("object { sphere { 0, 1 } }");
  REQUIRE(plain.entries.size() == 2);
  CHECK(plain.entries[0].value.rgb == Vec3(0, 0, 1));
  CHECK(plain.entries[1].value.rgb == Vec3(0, 1, 0));
  const auto coloured = pigment_map("object { Ball translate x rgb 1, rgb 0.5 } scale 2",
                                    "#declare Ball = sphere { 0, 1 translate y } ");
  CHECK(coloured.entries[1].value.rgb == Vec3(0.5));
  const auto& ball = *std::get<pattern::Inside>(coloured.pattern.kind).of;
  CHECK(ball.transform.point({0, 0, 0}) == Vec3(1, 1, 0));
  CHECK(std::holds_alternative<Sphere>(ball.shape));
  const auto nested = pigment_map("object { box { -1, 1 } pigment { bozo } pigment { rgb 0.5 } }");
  CHECK(nested.entries[0].value.map);
  const Material textured = material("texture { object { box { -1, 1 } texture { pigment { rgb 1 } } "
                                     "texture { pigment { rgb x } } } }");
  REQUIRE(textured.map);
  CHECK(textured.map->entries.size() == 2);
  CHECK(std::holds_alternative<pattern::Inside>(textured.map->pattern.kind));
  CHECK(normal("object { box { -1, 1 } normal { bumps } normal { dents } }").map->entries.size() == 2);
  const auto both = kind<pattern::Inside>("object { union { sphere { 0, 1 } plane { y, 0 } } }");
  CHECK(std::get<std::shared_ptr<const Csg>>(both.of->shape)->parts.size() == 2);
  CHECK(error_line("sphere { 0, 1 pigment { object { sphere { 0, 1 } rgb 1 rgb 0 rgb 1 } } }") ==
        "scene.pov:1:25: error: this pattern takes a list of 2, but it has 3 entries");
  CHECK_THAT(
      error_line("sphere { 0, 1 pigment { object { mesh { triangle { 0, x, y } inside_vector z } } } }"),
      Catch::Contains("not supported yet"));
}

TEST_CASE("modifiers of patterns") {
  const Pattern p =
      pattern_of("gradient x turbulence <1, 2, 3> octaves 3 omega 0.25 lambda 3 sine_wave frequency 2 "
                 "phase 0.5 noise_generator 1");
  CHECK(p.turbulence.amount == Vec3(1, 2, 3));
  CHECK(p.turbulence.octaves == 3);
  CHECK(p.turbulence.omega == 0.25);
  CHECK(p.turbulence.lambda == 3);
  CHECK(p.wave == Pattern::Wave::sine);
  CHECK(p.frequency == 2);
  CHECK(p.phase == 0.5);
  CHECK(p.noise_generator == 1);
  CHECK(pattern_of("bozo turbulence 0.5 octaves 99").turbulence.octaves == 10);
  CHECK(pattern_of("bozo turbulence 0.5").turbulence.amount == Vec3(0.5));
  CHECK(pattern_of("bozo poly_wave 3").wave_exponent == 3);
  CHECK(pattern_of("bozo poly_wave scale 2").wave_exponent == 1);
  CHECK(pattern_of("bozo cubic_wave scallop_wave").wave == Pattern::Wave::scallop);
  CHECK(error_line("sphere { 0, 1 pigment { bozo noise_generator 4 } }") ==
        "scene.pov:1:46: error: there are noise generators 1, 2 and 3");
  CHECK(error_line("sphere { 0, 1 pigment { bozo frequency 1/0 } }") ==
        "scene.pov:1:40: error: this number is not finite");
}

TEST_CASE("waves that patterns have by themselves") {
  for (const char* word : {"marble", "wood", "spiral1 2", "spiral2 2"})
    CHECK(pattern_of(word).wave == Pattern::Wave::triangle);
  for (const char* word : {"bozo", "gradient x", "onion", "waves"})
    CHECK(pattern_of(word).wave == Pattern::Wave::ramp);
  CHECK(pattern_of("wood ramp_wave").wave == Pattern::Wave::ramp);
}

TEST_CASE("what is done to space keeps its order") {
  const Pattern p =
      pattern_of("bozo scale 2 translate x warp { turbulence 0.5 octaves 2 } rotate y*90 turbulence 1");
  REQUIRE(p.space.size() == 3);
  CHECK(transform(p.space).point({1, 0, 0}) == Vec3(3, 0, 0));
  CHECK(std::get<Turbulence>(p.space[1]).octaves == 2);
  CHECK(std::get<Turbulence>(p.space[1]).amount == Vec3(0.5));
  CHECK(transform(p.space, 2).point({1, 0, 0}).z == Approx(-1));
  CHECK(p.turbulence.amount == Vec3(1));
  CHECK(error_line("sphere { 0, 1 pigment { bozo matrix <1,1,0, 1,1,0, 0,0,1, 0,0,0> } }") ==
        "scene.pov:1:30: error: this transformation is singular: it has no inverse");
  CHECK(error_line("sphere { 0, 1 pigment { bozo #for (I, 1, 65) warp { turbulence 1 } #end } }") ==
        "scene.pov:1:46: error: a pattern has no more than 64 warps and transformations between them");
  CHECK(error_line("sphere { 0, 1 pigment { bozo #for (I, 1, 9999) rotate 1 #end } }").empty());
}

TEST_CASE("warps") {
  const auto space =
      pattern_of("bozo warp { repeat -2*y flip x offset <1, 2, 3> } "
                 "warp { black_hole <1, 2, 3>, 0.5 strength 2 falloff 3 inverse repeat x turbulence 0.1 } "
                 "warp { planar z, 0.7 } warp { toroidal orientation y dist_exp 2 major_radius 3 }")
          .space;
  REQUIRE(space.size() == 4);
  const auto& repeat = std::get<warp::Repeat>(space[0]);
  CHECK(repeat.axis == 1);
  CHECK(repeat.width == -2);
  CHECK(repeat.flip == Vec3(1, 0, 0));
  CHECK(repeat.offset == Vec3(1, 2, 3));
  const auto& hole = std::get<warp::BlackHole>(space[1]);
  CHECK(hole.centre == Vec3(1, 2, 3));
  CHECK(hole.radius == 0.5);
  CHECK(hole.strength == 2);
  CHECK(hole.falloff == 3);
  CHECK(hole.is_inverse);
  CHECK(hole.repeat == Vec3(1.1, 0, 0)); // as far as the hole reaches
  CHECK(hole.turbulence == Vec3(0.1));
  CHECK(std::get<warp::Mapping>(space[2]).distance == 0.7);
  const auto& torus = std::get<warp::Mapping>(space[3]);
  CHECK(torus.shape == warp::Mapping::Shape::toroidal);
  CHECK(torus.orientation == Vec3(0, 1, 0));
  CHECK(torus.distance_exponent == 2);
  CHECK(torus.major_radius == 3);
  CHECK(error_line("sphere { 0, 1 pigment { bozo warp { repeat <1, 1, 0> } } }") ==
        "scene.pov:1:44: error: a warp repeats along one axis");
  CHECK(error_line("sphere { 0, 1 pigment { bozo warp { repeat x metric 2 } } }") ==
        "scene.pov:1:46: error: 'metric' means nothing to this warp");
  CHECK(error_line("sphere { 0, 1 pigment { bozo warp { marble } } }") ==
        "scene.pov:1:37: error: 'marble' is no warp");
}

TEST_CASE("colour maps") {
  const auto map =
      pigment_map("gradient x color_map { [0 rgb 1] [0.5, color rgbt <1, 0, 0, 0.25>] [1 Black] }",
                  "#declare Black = rgb 0; ");
  REQUIRE(map.entries.size() == 3);
  CHECK(map.entries[1].position == 0.5);
  CHECK(map.entries[1].value.transmit == 0.25);
  CHECK(map.entries[2].value.rgb == Vec3(0));
  CHECK_FALSE(map.is_average);
  const auto old = pigment_map(
      "gradient x colour_map { [0.2 0.5 color red 1 color blue 1] [0.5, 1 color rgb 0, color rgb 1] }");
  REQUIRE(old.entries.size() == 4);
  CHECK(old.entries[0].position == 0.2);
  CHECK(old.entries[0].value.rgb == Vec3(1, 0, 0));
  CHECK(old.entries[1].position == 0.5);
  CHECK(old.entries[1].value.rgb == Vec3(0, 0, 1));
  CHECK(
      pigment_map("bozo color_map { M }", "#declare M = color_map { [0.3 rgb 1] } ").entries.at(0).position ==
      0.3);
  CHECK(pigment_map("bozo color_map { M[1] }",
                    "#declare M = array[2]; #declare M[1] = color_map { [0.3 rgb 1] } ")
            .entries.size() == 1);
  CHECK(
      pigment_map("bozo T(color_map { [0.3 rgb 1] })", "#macro T(M) color_map { M } #end ").entries.size() ==
      1);
  CHECK(error_line("sphere { 0, 1 pigment { bozo color_map { [0 1] } } }") ==
        "scene.pov:1:45: error: expected a colour, found a float");
  CHECK(error_line("sphere { 0, 1 pigment { bozo color_map { } } }") ==
        "scene.pov:1:42: error: unexpected '}'");
  CHECK(error_line("sphere { 0, 1 pigment { rgb 1 color_map { [0 rgb 1] } } }") ==
        "scene.pov:1:31: error: a map needs a pattern in front of it");
  CHECK(error_line("sphere { 0, 1 pigment { checker color_map { [0 rgb 1] } } }") ==
        "scene.pov:1:33: error: this pattern takes a list, not a map");
}

TEST_CASE("a pigment with a map alone is black") {
  const std::string map = "color_map { [0 rgb x] [1 rgb z] } turbulence 1";
  CHECK(material("pigment { " + map + " }").pigment == Pigment());
  CHECK(material("pigment { " + map + " }", "#default { pigment { bozo } } ").pigment.map != nullptr);
  CHECK_FALSE(error_line("#default { pigment { rgb 1 } } sphere { 0, 1 pigment { " + map + " } }").empty());
}

TEST_CASE("positions in a map ascend") {
  const auto map = pigment_map("gradient x color_map { [0.8 rgb <1, 0, 0>] [0.2 rgb 0] }");
  CHECK(map.entries[0].position == 0.2);
  CHECK(map.entries[1].position == 0.2);
  CHECK(map.entries[0].value.rgb == Vec3(1, 0, 0));
}

TEST_CASE("patterns have colours of their own") {
  const auto grey = pigment_map("gradient x");
  REQUIRE(grey.entries.size() == 2);
  CHECK(grey.entries[0].value.rgb == Vec3(0));
  CHECK(grey.entries[1].value.rgb == Vec3(1));
  CHECK(pigment_map("spotted").entries.size() == 2);
  CHECK(pigment_map("bozo").entries.size() == 6);
  CHECK(pigment_map("agate").entries.size() == 6);
  CHECK(pigment_map("marble").entries.size() == 4);
  CHECK(pigment_map("wood").entries.size() == 2);
  CHECK(pigment_map("radial").entries.size() == 4);
  CHECK(pigment_map("checker").entries.at(1).value.rgb == Vec3(0, 1, 0));
  CHECK(pigment_map("cubic").entries.size() == 6);
  CHECK(pigment_map("brick").entries.at(1).value.rgb == Vec3(0.6, 0.15, 0.15));
}

TEST_CASE("lists of colours and pigments") {
  const auto checker = pigment_map("checker rgb 0.25, color Red scale 2", "#declare Red = rgb <1, 0, 0>; ");
  REQUIRE(checker.entries.size() == 2);
  CHECK(checker.entries[0].value.rgb == Vec3(0.25));
  CHECK(checker.entries[1].value.rgb == Vec3(1, 0, 0));
  CHECK(checker.entries[1].position == 1);
  CHECK(pigment_map("hexagon rgb 1").entries.at(1).value.rgb == Vec3(0, 1, 0));
  const auto nested = pigment_map("checker pigment { bozo } pigment { rgb 0.5 }");
  CHECK(nested.entries[0].value.map);
  CHECK(nested.entries[1].value.rgb == Vec3(0.5));
  CHECK(pigment_map("checker pigment { rgb 1 }", "#default { pigment { rgb 0.75 } } ")
            .entries.at(1)
            .value.rgb == Vec3(0.75));
  CHECK(error_line("sphere { 0, 1 pigment { checker rgb 1 rgb 0 rgb 1 } }") ==
        "scene.pov:1:25: error: this pattern takes a list of 2, but it has 3 entries");
}

TEST_CASE("a comma behind the last entry of a list") {
  CHECK(pigment_map("checker rgb 1, rgb 0.5, scale 2").entries.at(1).value.rgb == Vec3(0.5));
  CHECK(pigment_map("checker rgb 1,").entries.at(1).value.rgb == Vec3(0, 1, 0));
  const auto brick = pigment_map("brick rgb 1, rgb 0.5, brick_size 0.25");
  CHECK(brick.entries.at(1).value.rgb == Vec3(0.5));
  CHECK(std::get<pattern::Brick>(brick.pattern.kind).size == Vec3(0.25));
  CHECK(pigment_map("hexagon rgb 1, rgb 0, rgb 0.5,").entries.at(2).value.rgb == Vec3(0.5));
  CHECK(pigment_map("square rgb 1, rgb 0, rgb 1, rgb 0.5,").entries.at(3).value.rgb == Vec3(0.5));
  CHECK(pigment_map("triangular rgb 1, rgb 0, rgb 1, rgb 0, rgb 1, rgb 0.5,").entries.at(5).value.rgb ==
        Vec3(0.5));
  CHECK(pigment_map("object { sphere { 0, 1 } rgb 1, rgb 0.5, }").entries.at(1).value.rgb == Vec3(0.5));
  CHECK(pigment_map("checker pigment { rgb 1 }, pigment { rgb 0.5 }, scale 2").entries.at(1).value.rgb ==
        Vec3(0.5));
  CHECK(normal("checker normal { bumps 1 }, normal { dents 2 }, scale 2").map->entries.at(1).value.amount ==
        2);
  const Material textures =
      material("texture { checker texture { pigment { rgb 1 } }, texture { pigment { rgb 0.5 } }, scale 2 }");
  CHECK(textures.map->entries.at(1).value.pigment.rgb == Vec3(0.5));
  // Nowhere else.
  CHECK_FALSE(error_line("sphere { 0, 1 pigment { checker, rgb 1 rgb 0 } }").empty());
  CHECK_FALSE(error_line("sphere { 0, 1 pigment { checker rgb 1,, rgb 0 } }").empty());
  CHECK_FALSE(error_line("sphere { 0, 1 pigment { checker rgb 1, rgb 0,, } }").empty());
}

TEST_CASE("maps of pigments and averages") {
  const auto map = pigment_map("gradient x pigment_map { [0 bozo scale 2] [0.5 rgb 1] [1 P rotate x] }",
                               "#declare P = pigment { marble } ");
  REQUIRE(map.entries.size() == 3);
  CHECK(map.entries[0].value.map->pattern.space.size() == 1);
  CHECK(map.entries[1].value.rgb == Vec3(1));
  CHECK(std::holds_alternative<pattern::Marble>(map.entries[2].value.map->pattern.kind));
  const auto average = pigment_map("average pigment_map { [1 rgb 1] [3 rgb 0] [bozo] }");
  CHECK(average.is_average);
  CHECK(average.entries[1].position == 3);
  CHECK(average.entries[2].position == 1);
  CHECK(error_line("sphere { 0, 1 pigment { average } }") == "scene.pov:1:23: error: an average needs a map");
}

TEST_CASE("a pigment builds on another one") {
  const std::string before =
      "#declare P = pigment { gradient x color_map { [0 rgb 0] [1 rgb 0.5] } sine_wave scale 2 } ";
  const auto turned = pigment_map("P translate x", before);
  REQUIRE(turned.pattern.space.size() == 1);
  CHECK(transform(turned.pattern.space).point({1, 0, 0}) == Vec3(3, 0, 0));
  const auto other = pigment_map("P gradient y", before);
  CHECK(other.entries[1].value.rgb == Vec3(0.5));
  CHECK(other.pattern.wave == Pattern::Wave::sine);
  CHECK(pigment_map("P marble", before).pattern.wave == Pattern::Wave::triangle);
  CHECK(pigment_map("P color_map { [0 rgb 1] }", before).entries.size() == 1);
  const Material plain = material("pigment { P rgb 0.25 }", before);
  CHECK_FALSE(plain.pigment.map);
  CHECK(plain.pigment.rgb == Vec3(0.25));
  CHECK(pigment_map("scale 2", "#default { pigment { checker } } ").pattern.space.size() == 1);
}

TEST_CASE("facets are for normals alone") {
  CHECK(error_line("sphere { 0, 1 normal { facets coords 1 } }").empty());
  CHECK(error_line("sphere { 0, 1 pigment { facets coords 1 } }") ==
        "scene.pov:1:23: error: 'facets' is a pattern of normals alone");
}

TEST_CASE("normals") {
  const Normal n = normal("bumps 0.4 scale 2 accuracy 0.01 turbulence 0.5");
  CHECK(n.amount == 0.4);
  CHECK(n.accuracy == 0.01);
  CHECK(n.pattern.space.size() == 1);
  CHECK(normal("bumps").amount == 0.5);
  CHECK(normal("bumps 0.4 bump_size 2").amount == 2);
  const std::string before = "#declare N = normal { ripples 0.4 frequency 3 } ";
  CHECK(normal("N 0.1 scale 2", before).amount == 0.1);
  CHECK(normal("N 0.1", before).pattern.frequency == 3);
  const Normal mapped = normal("gradient x normal_map { [0 bumps 0.4] [0.5 N scale 2] [1 M] }",
                               before + "#declare M = normal { average normal_map { [1 N] [dents 1] } } ");
  REQUIRE(mapped.map);
  REQUIRE(mapped.map->entries.size() == 3);
  CHECK(mapped.map->entries[0].value.amount == 0.4);
  CHECK(mapped.map->entries[2].value.map->is_average);
  CHECK(normal("checker 0.25").amount == 0.25);
  CHECK_FALSE(normal("checker 0.25").map);
  const Normal list = normal("checker normal { N } normal { bumps 2 }", before);
  CHECK(list.map->entries.at(1).value.amount == 2);
  CHECK_FALSE(material("normal { bump_size 2 }").normal);
  CHECK(material("texture { pigment { rgb 1 } }", "#default { normal { bumps 0.3 } } ").normal->amount ==
        0.3);
  // A default without a pattern says what the normals to come start from, those of maps too.
  CHECK(normal("bumps", "#default { normal { bump_size 1.5 } } ").amount == 1.5);
  CHECK(normal("bumps", "#default { normal { scale 2 } } ").pattern.space.size() == 1);
  CHECK(normal("wood normal_map { [0 bumps] [1 dents] }", "#default { normal { bump_size 1.5 } } ")
            .map->entries.at(1)
            .value.amount == 1.5);
  CHECK(material("texture { normal { bump_size 1.5 } normal { bumps } }").normal->amount == 1.5);
  const Normal sloped = normal("bozo 1 slope_map { S }",
                               "#declare S = slope_map { [0.5 <0.25, 1>] [0.2, <1, -1>] [1 <0, 0>] } ");
  REQUIRE(sloped.slopes.size() == 3);
  CHECK(sloped.slopes[0].height == 0.25);
  CHECK(sloped.slopes[1].slope == -1);
  CHECK(sloped.slopes[1].position == 0.5);
}

TEST_CASE("patterns of textures") {
  const std::string before = "#declare A = texture { pigment { rgb 1 } finish { phong 1 } } "
                             "#declare B = texture { pigment { bozo } normal { bumps } scale 2 } ";
  const Material map =
      material("texture { gradient x texture_map { [0 A] [0.5 B rotate x] [1 pigment { rgb 0.5 }] } "
               "scale 3 turbulence 0.5 }",
               before);
  REQUIRE(map.map);
  REQUIRE(map.map->entries.size() == 3);
  CHECK(map.map->entries[0].value.finish.phong == 1);
  CHECK(map.map->entries[1].value.normal);
  CHECK(map.map->entries[1].value.pigment.map->pattern.space.size() == 1);
  CHECK(map.map->entries[2].value.pigment.rgb == Vec3(0.5));
  CHECK(map.map->pattern.space.size() == 1);
  CHECK(map.map->pattern.turbulence.amount == Vec3(0.5));
  const Material list =
      material("texture { checker texture { A } }", before + "#default { pigment { rgb 0.75 } } ");
  REQUIRE(list.map);
  CHECK(list.map->entries.at(1).value.pigment.rgb == Vec3(0.75));
  CHECK(material("texture { average texture_map { [A] [2 A] } }", before).map->is_average);
  CHECK(material("texture { gradient x texture_map { M } }",
                 before + "#declare M = texture_map { [0 A] [1 B] } ")
            .map->entries.size() == 2);
  const Material layers = material("texture { gradient x texture_map { [0 A] [1 L] } }",
                                   before + "#declare L = texture { A } texture { pigment { rgbt 0.5 } } ");
  CHECK(layers.map->entries.at(1).value.below);
  CHECK(error_line(before + "sphere { 0, 1 texture { checker texture { A } pigment { rgb 1 } } }")
            .find("has no pigment, normal or finish of its own") != std::string::npos);
  CHECK(error_line(before + "sphere { 0, 1 texture { checker texture { A } } finish { phong 1 } }")
            .find("has no pigment, normal or finish of its own") != std::string::npos);
  CHECK(error_line(before + "sphere { 0, 1 texture { gradient x } }").find("needs a 'texture_map'") !=
        std::string::npos);
  CHECK(error_line(before + "sphere { 0, 1 texture { A frequency 2 } }").find("has no pattern of textures") !=
        std::string::npos);
}

TEST_CASE("tiles are the second texture where checker has its first") {
  const std::string a = "texture { pigment { rgb 1 } } ", b = "texture { pigment { rgb 0.5 } } ";
  const Material tiles = material("texture { tiles { " + a + "tile2 " + b + "} scale 2 }");
  REQUIRE(tiles.map);
  CHECK(std::holds_alternative<pattern::Checker>(tiles.map->pattern.kind));
  CHECK(tiles.map->pattern.space.size() == 1);
  REQUIRE(tiles.map->entries.size() == 2);
  CHECK(tiles.map->entries[0].value.pigment.rgb == Vec3(0.5));
  CHECK(tiles.map->entries[1].value.pigment.rgb == Vec3(1));
  const Material layered =
      material("texture { tiles { " + a + "tile2 " + b + "texture { pigment { rgbt 0.5 } } } }");
  REQUIRE(layered.map);
  CHECK(layered.map->entries.at(0).value.below);
  CHECK_FALSE(error_line("sphere { 0, 1 texture { tiles { " + a + "} } }").empty());
  CHECK_FALSE(error_line("sphere { 0, 1 texture { tiles { tile2 " + a + "} } }").empty());
}

TEST_CASE("layers") {
  const std::string before =
      "#declare A = texture { pigment { rgb 1 } } #declare B = texture { pigment { rgbt 0.5 } } "
      "#declare C = texture { pigment { bozo color_map { [0 rgb 1] [1 rgbt 0.25] } } } "
      "#declare D = texture { pigment { bozo } } ";
  const Material two = material("texture { A } texture { B }", before);
  CHECK(two.pigment.transmit == 0.5);
  REQUIRE(two.below);
  CHECK(two.below->pigment.rgb == Vec3(1));
  CHECK_FALSE(two.below->below);
  CHECK(material("texture { A } texture { C }", before).below);
  CHECK_FALSE(material("texture { B } texture { D }", before).below);
  const Material stack = material("texture { A } texture { T } texture { B }",
                                  before + "#declare T = texture { B } texture { C } ");
  CHECK(stack.below->pigment.map);
  CHECK(stack.below->below->pigment.transmit == 0.5);
  CHECK(stack.below->below->below->pigment.rgb == Vec3(1));
  CHECK_FALSE(material("texture { B } texture { T }", before + "#declare T = texture { A } texture { B } ")
                  .below->below);
  const Material changed = material("texture { A } texture { B } pigment { rgbt 0.25 }", before);
  CHECK(changed.pigment.transmit == 0.25);
  CHECK(changed.below->pigment.rgb == Vec3(1));
  CHECK(error_line(before + "sphere { 0, 1 " + repeated("texture { B } ", 64) + "}").empty());
  CHECK(error_line(before + "sphere { 0, 1 " + repeated("texture { B } ", 65) + "}")
            .find("at most 64 layers") != std::string::npos);
  CHECK(error_line(before +
                   "#declare T = texture { B } #for (I, 1, 9) #declare T = texture { T } texture { T } #end")
            .find("at most 64 layers") != std::string::npos);
  CHECK(error_line(before + "sphere { 0, 1 texture { A } texture { checker texture { A } } }")
            .find("cannot be one of several layers") != std::string::npos);
}

TEST_CASE("objects move the textures that they have") {
  const auto place = [](const std::string& object, const std::string& before = "") {
    const Material m = [&] {
      const Scene scene =
          parse("#declare P = pigment { checker } #declare T = texture { P } " + before + object);
      return scene.materials.at(scene.objects.at(0).material);
    }();
    return origin(m.pigment.map->pattern.space);
  };
  CHECK(place("sphere { 0, 1 pigment { P } translate x }") == Vec3(1, 0, 0));
  CHECK(place("sphere { 0, 1 translate x pigment { P } }") == Vec3(0, 0, 0));
  CHECK(place("sphere { 0, 1 translate x pigment { P translate y } translate z }") == Vec3(0, 1, 1));
  CHECK(place("object { sphere { 0, 1 pigment { P } translate x } translate y }") == Vec3(1, 1, 0));
  CHECK(place("union { sphere { 0, 1 pigment { P } translate x } translate y }") == Vec3(1, 1, 0));
  CHECK(place("union { sphere { 0, 1 translate x } pigment { P } translate y }") == Vec3(0, 1, 0));
  CHECK(place("union { sphere { 0, 1 translate x } translate z pigment { P } translate y }") ==
        Vec3(0, 1, 0));
  CHECK(place("union { union { sphere { 0, 1 translate x } pigment { P } } translate y }") == Vec3(0, 1, 0));
  CHECK(place("sphere { 0, 1 translate x }", "#default { texture { T } } ") == Vec3(0, 0, 0));
  CHECK(place("union { sphere { 0, 1 } translate x }", "#default { texture { T } } ") == Vec3(0, 0, 0));
  CHECK(place("sphere { 0, 1 finish { phong 1 } translate x }", "#default { texture { T } } ") ==
        Vec3(1, 0, 0));
  CHECK(place("sphere { 0, 1 texture { T translate x } translate y finish { phong 1 } translate z }") ==
        Vec3(1, 1, 1));
  CHECK(place("sphere { 0, 1 material { texture { T translate x } translate y } translate z }") ==
        Vec3(1, 1, 1));
  CHECK(place("sphere { 0, 1 texture { T } translate x pigment { translate y } }") == Vec3(1, 1, 0));
}

TEST_CASE("all that a texture has moves together") {
  const Material m = material(
      "texture { pigment { bozo } normal { bumps } } texture { pigment { bozo color_map { [0 rgbt 1] } } } "
      "translate x");
  CHECK(origin(m.pigment.map->pattern.space) == Vec3(1, 0, 0));
  REQUIRE(m.below);
  CHECK(origin(m.below->pigment.map->pattern.space) == Vec3(1, 0, 0));
  CHECK(origin(m.below->normal->pattern.space) == Vec3(1, 0, 0));
  const Material map = material("texture { checker texture { pigment { bozo } } } translate x");
  CHECK(origin(map.map->pattern.space) == Vec3(1, 0, 0));
  // Entries live in the space of the pattern they belong to.
  CHECK(map.map->entries[0].value.pigment.map->pattern.space.empty());
  const Material second = material(
      "texture { pigment { bozo } } translate x texture { pigment { bozo color_map { [0 rgbt 1] } } }");
  CHECK(second.pigment.map->pattern.space.empty());
  CHECK(origin(second.below->pigment.map->pattern.space) == Vec3(1, 0, 0));
  CHECK(error_line("sphere { 0, 1 pigment { bozo scale 1e-100 } scale 1e-10 }").find("is singular") !=
        std::string::npos);
}

TEST_CASE("pigments, normals and textures on surface coordinates") {
  const auto pattern = [](const std::string& modifiers, const std::string& before = "") {
    return material(modifiers, before).pigment.map->pattern;
  };
  const std::string declared = "#declare P = pigment { uv_mapping gradient x scale 2 } ";
  for (const std::string items :
       {"pigment { uv_mapping gradient x scale 2 } scale 3", "pigment { P scale 5 } scale 3",
        "pigment { P scale 5 turbulence 1 frequency 3 }", "pigment { uv_mapping P scale 5 }",
        "texture { pigment { P } scale 3 }", "texture { uv_mapping pigment { gradient x } scale 2 } scale 3",
        "texture { T scale 3 }", "texture { uv_mapping T scale 3 }",
        "uv_mapping pigment { gradient x scale 2 } scale 3",
        "uv_mapping texture { pigment { gradient x } scale 2 } scale 3",
        "uv_mapping texture { T } scale 3"}) {
    INFO(items);
    const Pattern found = pattern(items, declared + "#declare T = texture { uv_mapping pigment { P } }");
    CHECK(found.uv_mapping);
    CHECK(found.turbulence.amount == Vec3(0));
    CHECK(found.frequency == 1);
    REQUIRE(found.space.size() == 1);
    CHECK(transform(found.space).rows[0].x == 2);
  }
  // Another pattern is none of that.
  const Pattern other = pattern("pigment { P checker }", declared);
  CHECK_FALSE(other.uv_mapping);
  CHECK(other.space.empty());
  CHECK_FALSE(material("pigment { uv_mapping rgb x }").pigment.map);
  // Everything in a map on the surface is there; what is there by itself keeps its place.
  const Material mapped =
      material("texture { uv_mapping gradient y texture_map { [0 pigment { P }] [1 pigment { gradient x }] } "
               "scale 4 } scale 3",
               declared);
  CHECK(mapped.map->pattern.uv_mapping);
  CHECK(transform(mapped.map->pattern.space).rows[0].x == 4);
  CHECK(mapped.map->entries[0].value.pigment.map->pattern.uv_mapping);
  CHECK_FALSE(mapped.map->entries[1].value.pigment.map->pattern.uv_mapping);
  const Material both = material("uv_mapping pigment { gradient x } normal { bumps scale 2 } scale 3");
  CHECK(both.normal->pattern.uv_mapping);
  CHECK(transform(both.normal->pattern.space).rows[0].x == 2);
  CHECK(material("normal { uv_mapping N 2 }", "#declare N = normal { bumps }").normal->amount == 2);
  CHECK(material("normal { uv_mapping bumps }").normal->pattern.uv_mapping);
  // What moves a texture that is on the surface turns its normals.
  const auto turned = [](const std::string& modifiers) {
    return material(modifiers).normal->pattern.normal_space.rows[0].x;
  };
  const std::string rough = "pigment { rgb 1 } normal { bumps scale 2 } ";
  CHECK(turned("texture { uv_mapping " + rough + "scale 3 } scale 4") == 4);
  CHECK(turned("texture { " + rough + "scale 3 } scale 4") == 1);
  CHECK(turned("uv_mapping texture { " + rough + "scale 3 } scale 4") == 1);
  CHECK(turned("texture { pigment { rgb 1 } normal { uv_mapping bumps scale 2 } scale 3 } scale 4") == 1);
  const Material layers = material("uv_mapping texture { pigment { checker } } texture { pigment { bozo "
                                   "color_map { [0 rgbt 1] [1 rgbt 1] } } }");
  CHECK(layers.pigment.map->pattern.uv_mapping);
  CHECK(layers.below->pigment.map->pattern.uv_mapping);
}

TEST_CASE("parts of unions on surface coordinates") {
  const auto space = [](const std::string& object) {
    const Scene scene = parse(object);
    const Pattern& pattern = scene.materials.at(scene.objects.at(0).material).pigment.map->pattern;
    CHECK(pattern.uv_mapping);
    return pattern.space.empty() ? 1 : transform(pattern.space).rows[0].x;
  };
  CHECK(space("union { sphere { 0, 1 pigment { checker } } uv_mapping scale 2 }") == 2);
  CHECK(space("union { sphere { 0, 1 uv_mapping pigment { checker } } scale 2 }") == 1);
  CHECK(space("union { sphere { 0, 1 uv_mapping } pigment { checker } scale 2 }") == 2);
  CHECK(space("union { sphere { 0, 1 } uv_mapping pigment { checker } scale 2 }") == 1);
  const std::string mesh =
      "#declare T = texture { pigment { checker } } mesh { triangle { 0, x, y texture { T } } ";
  const auto of_mesh = [&](const std::string& modifiers) {
    const Scene scene = parse(mesh + modifiers + " }");
    const auto& triangles = std::get<std::shared_ptr<const Mesh>>(scene.objects.at(0).shape)->triangles;
    const Pattern& pattern = scene.materials.at(triangles.at(0).material[0]).pigment.map->pattern;
    CHECK(pattern.uv_mapping);
    return pattern.space.empty() ? 1 : transform(pattern.space).rows[0].x;
  };
  CHECK(of_mesh("uv_mapping scale 2") == 1);
  CHECK(of_mesh("scale 2 uv_mapping") == 2);
}

TEST_CASE("where surface coordinates cannot be") {
  CHECK_THAT(error_line("sphere { 0, 1 pigment { checker } uv_mapping }"), Catch::Contains("in front of"));
  CHECK_THAT(error_line("sphere { 0, 1 texture { uv_mapping pigment { checker } } finish { phong 1 } }"),
             Catch::Contains("uv_mapping"));
  CHECK_THAT(
      error_line(
          "sphere { 0, 1 texture { pigment { checker } } texture { uv_mapping pigment { checker } } }"),
      Catch::Contains("layers"));
  CHECK_THAT(error_line("sky_sphere { pigment { uv_mapping checker } }"), Catch::Contains("no surface"));
  CHECK_THAT(
      error_line("sky_sphere { pigment { checker pigment { uv_mapping checker }, pigment { rgb 1 } } }"),
      Catch::Contains("no surface"));
}

TEST_CASE("textures that are the same everywhere are shared") {
  const auto materials = [](const std::string& texture) {
    return parse("#declare S = sphere { 0, 1 " + texture +
                 " } #for (I, 1, 50) object { S translate I*x } #end")
        .materials.size();
  };
  CHECK(materials("pigment { rgb 1 }") == 1);
  CHECK(materials("texture { pigment { rgb 1 } } texture { pigment { rgbt 1 } }") == 1);
  CHECK(materials("pigment { bozo }") == 50);
  CHECK(parse("#declare T = texture { pigment { bozo } } #for (I, 1, 50) sphere { I, 1 texture { T } } #end")
            .materials.size() == 1);
}

TEST_CASE("meshes move their own textures") {
  const std::string mesh = "mesh { triangle { 0, x, y texture { T } } triangle { 0, x, z } texture { U } }";
  const auto scene_of = [&](const std::string& pigment) {
    return parse("#declare T = texture { pigment { " + pigment +
                 " } } #declare U = texture { pigment { rgb 1 } } "
                 "#declare M = " +
                 mesh + " object { M } object { M translate x } object { M translate x }");
  };
  const auto mesh_of = [](const Scene& scene, std::size_t object) {
    return std::get<std::shared_ptr<const Mesh>>(scene.objects.at(object).shape);
  };
  const Scene constant = scene_of("rgb 0.5");
  CHECK(mesh_of(constant, 0) == mesh_of(constant, 1));
  CHECK(constant.materials.size() == 2);
  const Scene patterned = scene_of("checker");
  const auto second = mesh_of(patterned, 1);
  CHECK(mesh_of(patterned, 0) != second);
  CHECK(patterned.materials.size() == 3);
  CHECK(origin(patterned.materials.at(second->triangles.at(0).material[0]).pigment.map->pattern.space) ==
        Vec3(1, 0, 0));
}

TEST_CASE("global settings of patterns") {
  CHECK(parse("sphere { 0, 1 }").noise_generator == 2);
  CHECK(parse("#version 3.1; sphere { 0, 1 }").noise_generator == 1);
  CHECK(parse("#version 3.1; sphere { 0, 1 } #version 3.5;").noise_generator == 2);
  const Scene scene = parse("global_settings { noise_generator 3 number_of_waves 5 }");
  CHECK(scene.noise_generator == 3);
  CHECK(scene.number_of_waves == 5);
  CHECK(error_line("global_settings { noise_generator 0 }") ==
        "scene.pov:1:35: error: there are noise generators 1, 2 and 3");
  CHECK(error_line("global_settings { number_of_waves 1e9 }") ==
        "scene.pov:1:35: error: there are at most 1000 waves");
}

TEST_CASE("sky spheres") {
  const Scene scene = parse("#declare S = sky_sphere { pigment { gradient y } rotate x*90 } "
                            "sky_sphere { S pigment { rgbt 0.5 } pigment { bozo } translate y }");
  REQUIRE(scene.sky_sphere.size() == 3);
  CHECK(transform(scene.sky_sphere[0].map->pattern.space).point({0, 1, 0}).z == Approx(1));
  CHECK(scene.sky_sphere[1].transmit == 0.5);
  CHECK(origin(scene.sky_sphere[2].map->pattern.space) == Vec3(0, 1, 0));
  CHECK(parse("sky_sphere { pigment { rgb 1 } } sky_sphere { pigment { rgb 0.5 } }").sky_sphere.at(0).rgb ==
        Vec3(0.5));
  CHECK(error_line("sky_sphere { }") == "scene.pov:1:1: error: a sky_sphere needs a pigment");
  CHECK(error_line("sky_sphere { pigment { tiling 9 } }") ==
        "scene.pov:1:24: error: 'tiling' is not supported yet");
}

TEST_CASE("a sky sphere's emission multiplies its colours") {
  const auto sky = [](const std::string& items) { return parse("sky_sphere { " + items + " }").sky_sphere; };
  const auto layers = sky("pigment { rgb <0.25, 0.5, 1> } emission rgb <2, 1, 0.5> "
                          "pigment { gradient x color_map { [0 rgbt <1, 1, 1, 0.5>] [1 rgb 0.5] } }");
  REQUIRE(layers.size() == 2);
  CHECK(layers[0].rgb == Vec3(0.5));
  CHECK(layers[1].map->entries[0].value.rgb == Vec3(2, 1, 0.5));
  CHECK(layers[1].map->entries[0].value.transmit == 0.5);
  CHECK(layers[1].map->entries[1].value.rgb == Vec3(1, 0.5, 0.25));
  CHECK(sky("pigment { gradient x pigment_map { [0 checker rgb 1 rgb 0.5] [1 rgb 1] } } emission 0.5")[0]
            .map->entries[0]
            .value.map->entries[1]
            .value.rgb == Vec3(0.25));
  // The last one counts.
  CHECK(
      parse("#declare S = sky_sphere { pigment { rgb 1 } emission 2 } sky_sphere { S }").sky_sphere[0].rgb ==
      Vec3(2));
  CHECK(
      parse(
          "#declare S = sky_sphere { pigment { rgb 1 } emission 2 } sky_sphere { S emission 3 emission 0.5 }")
          .sky_sphere[0]
          .rgb == Vec3(0.5));
  CHECK(
      error_line("sky_sphere { pigment { rgbf 0.5 } emission 2 }") ==
      "scene.pov:1:35: error: 'emission' of a sky_sphere whose pigments have a filter is not supported yet");
  CHECK(error_line("sky_sphere { pigment { rgbf 0.5 } emission 1 }").empty());
}

TEST_CASE("what patterns lack is an error where it is used") {
  const auto refused = [](const std::string& pigment) {
    const std::string declared = "#declare P = pigment { " + pigment + " } ";
    CHECK(error_line(declared).empty());
    return error_line(declared + "sphere { 0, 1 pigment { P } }");
  };
  CHECK(refused("tiling 20 scale 2") == "scene.pov:1:24: error: 'tiling' is not supported yet");
  CHECK(refused("density_file df3 \"x\"") == "scene.pov:1:24: error: 'density_file' is not supported yet");
  CHECK(refused("gradient x pigment_map { [0 rgb 1] [1 tiling 3] }") ==
        "scene.pov:1:62: error: 'tiling' is not supported yet");
  CHECK(error_line("camera { normal { bumps 1 } } sphere { 0, 1 }") ==
        "scene.pov:1:10: error: 'normal' is not supported yet");
}

TEST_CASE("maps are bounded") {
  for (const std::string map :
       {"color_map { #for (I, 1, N) [I rgb 1] #end }", "slope_map { #for (I, 1, N) [I <0, 1>] #end }"}) {
    CHECK(error_line("#declare N = 256; #declare M = " + map).empty());
    CHECK(error_line("#declare N = 257; #declare M = " + map).find("a map has at most 256 entries") !=
          std::string::npos);
  }
  const auto nested = [](int depth, const std::string& kind) {
    return error_line(
        "#declare P = pigment { rgb 1 } #declare N = normal { bumps } #declare T = texture { P } "
        "#for (I, 1, " +
        std::to_string(depth) + ") " + kind + " #end sphere { 0, 1 texture { T } }");
  };
  const std::string pigments = "#declare P = pigment { checker pigment { P } pigment { P } }";
  const std::string normals = "#declare N = normal { gradient x normal_map { [0 N] [1 N] } }";
  const std::string textures = "#declare T = texture { checker texture { T } texture { T } }";
  for (const std::string& kind : {pigments, normals, textures}) {
    CHECK(nested(kDeepestMap, kind).empty());
    CHECK(nested(kDeepestMap + 1, kind)
              .find("maps are nested more than " + std::to_string(kDeepestMap) + " deep") !=
          std::string::npos);
  }
  ParseOptions options;
  options.limits.map_entries = 20;
  CHECK(error_line("#for (I, 1, 11) sphere { 0, 1 pigment { checker } translate I } #end", options)
            .find("more than 20 entries") != std::string::npos);
  CHECK(error_line("sphere { 0, 1 pigment { bozo color_map { [1/0 rgb 1] } } }") ==
        "scene.pov:1:43: error: this number is not finite");
}

TEST_CASE("the standard include files") {
  const std::filesystem::path folder = "/usr/share/povray-3.7/include";
  if (!std::filesystem::exists(folder)) {
    WARN("skipped: POV-Ray's include files are not installed");
    return;
  }
  for (const char* file : {"textures", "woods", "stones", "stones1", "stones2", "metals", "golds", "colors",
                           "finish", "skies", "stars", "glass", "woodmaps", "stoneold"}) {
    INFO(file);
    CHECK(error_line("#include \"colors.inc\" #include \"" + std::string(file) + ".inc\"").empty());
  }
  const Scene scene =
      parse("#include \"colors.inc\" #include \"woods.inc\" #include \"stones.inc\" #include \"metals.inc\" "
            "sphere { 0, 1 texture { T_Wood7 } } sphere { 0, 1 texture { T_Grnt5 } } "
            "sphere { 0, 1 texture { T_Brass_3C } }");
  CHECK(scene.materials.at(0).below);
  CHECK(scene.materials.at(1).pigment.map);
}
