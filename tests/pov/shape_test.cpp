// The shapes that are a name and a list of numbers.
#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using namespace celltrace;
using test::error_line;
using test::parse;

namespace {

template <class T> T only(const std::string& text) {
  const Scene scene = parse(text);
  REQUIRE(scene.objects.size() == 1);
  return std::get<T>(scene.objects[0].shape);
}

} // namespace

TEST_CASE("boxes") {
  const Box box = only<Box>("box { <1, 2, 3>, <-4, 5, 6> }");
  CHECK(box.corner[0] == Vec3(1, 2, 3));
  CHECK(box.corner[1] == Vec3(-4, 5, 6));
  CHECK(only<Box>("box { 0, 1 }").corner[1] == Vec3(1, 1, 1));
}

TEST_CASE("planes") {
  const Plane plane = only<Plane>("plane { <0, 3, 4>, -2 }");
  CHECK(plane.normal == Vec3(0, 3, 4));
  CHECK(plane.distance == -2);
  CHECK(only<Plane>("plane { y, 0 }").normal == Vec3(0, 1, 0));
}

TEST_CASE("quadrics") {
  const Quadric quadric = only<Quadric>("quadric { <1, 2, 3>, <4, 5, 6>, <7, 8, 9>, 10 }");
  CHECK(quadric.square == Vec3(1, 2, 3));
  CHECK(quadric.mixed == Vec3(4, 5, 6));
  CHECK(quadric.linear == Vec3(7, 8, 9));
  CHECK(quadric.constant == 10);
  CHECK(error_line("quadric { x, y, z }") == "scene.pov:1:1: error: expected 'quadric { <squares>, "
                                             "<products>, <linear>, constant }', found 3 arguments");
}

TEST_CASE("discs, with a hole or without") {
  Disc disc = only<Disc>("disc { <1, 2, 3>, z, 4 }");
  CHECK(disc.centre == Vec3(1, 2, 3));
  CHECK(disc.normal == Vec3(0, 0, 1));
  CHECK(disc.radius == 4);
  CHECK(disc.hole_radius == 0);
  CHECK(only<Disc>("disc { 0, z, 4, 2.5 }").hole_radius == 2.5);
  CHECK(only<Disc>("disc { 0, 0, 4 }").radius == 0);
}

TEST_CASE("cylinders and cones, open or closed") {
  const Cylinder cylinder = only<Cylinder>("cylinder { <1, 2, 3>, 2*y, 0.5 }");
  CHECK(cylinder.base == Vec3(1, 2, 3));
  CHECK(cylinder.cap == Vec3(0, 2, 0));
  CHECK(cylinder.radius == 0.5);
  CHECK_FALSE(cylinder.open);
  CHECK(only<Cylinder>("cylinder { 0 y 1 open pigment { rgb 1 } }").open);
  const Cone cone = only<Cone>("cone { x, 3, <1, 2, 3>, 0.25 }");
  CHECK(cone.base == Vec3(1, 0, 0));
  CHECK(cone.base_radius == 3);
  CHECK(cone.cap == Vec3(1, 2, 3));
  CHECK(cone.cap_radius == 0.25);
  CHECK_FALSE(cone.open);
  CHECK(only<Cone>("cone { 0, 1, y, 0 open scale 2 }").open);
}

TEST_CASE("tori") {
  const Torus torus = only<Torus>("torus { 2, 0.5 sturm rotate 90*x }");
  CHECK(torus.major_radius == 2);
  CHECK(torus.minor_radius == 0.5);
  CHECK(only<Torus>("torus { 0.5, 0.25 }").major_radius == 0.5);
  CHECK(parse("torus { 1, 0 } torus { 0, 1 } torus { -1, 0.2 } torus { 1, -0.2 }").objects.empty());
}

TEST_CASE("superellipsoids") {
  const Superellipsoid s = only<Superellipsoid>("superellipsoid { <0.25, 2> scale 2 }");
  CHECK(s.east_west == 0.25);
  CHECK(s.north_south == 2);
  CHECK(only<Superellipsoid>("superellipsoid { 1.5 }").north_south == 1.5);
  CHECK(error_line("superellipsoid { 2, 3 }") ==
        "scene.pov:1:1: error: expected 'superellipsoid { <east-west, north-south> }', found 2 arguments");
  CHECK(error_line("superellipsoid { <-1, 1> }") ==
        "scene.pov:1:1: error: a superellipsoid's first exponent must not be negative");
}

TEST_CASE("polygons") {
  using Loops = std::vector<std::vector<Vec3>>;
  const auto loops = [](const std::string& text) {
    const Scene scene = parse("polygon { " + text + " }");
    REQUIRE(scene.objects.size() == 1);
    return std::get<std::shared_ptr<const Polygon>>(scene.objects[0].shape)->loops;
  };
  const Loops square = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};
  CHECK(loops("4, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>") == square);
  CHECK(loops("5 <-1, -1> <1, -1> <1, 1> <-1, 1> <-1, -1> pigment { rgb 1 }") == square);
  CHECK(loops("5.7 <-1, -1> <1, -1> <1, 1> <-1, 1> <-1, -1, 1e-11> pigment { rgb 1 }") == square);
  const Loops two = loops("8, 0, x, y, 0, <.1, .1>, <.2, .1>, <.1, .2>, <.1, .1>");
  CHECK(two == Loops{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{.1, .1, 0}, {.2, .1, 0}, {.1, .2, 0}}});
  // What is on a line, nearly a point or not flat is not there.
  CHECK(loops("3, 0, x, 2*x").empty());
  CHECK(loops("3, 0, x/1000, y/1000").empty());
  CHECK(loops("4, 0, x, <1, 1, 1e-9>, y").empty());
  CHECK(loops("4, 0, x, <1, 1, 1e-11>, y").size() == 1);
  CHECK(loops("5, 0, x/2, x, y, 0").size() == 1);
  CHECK(error_line("polygon { 2, 0, x }") == "scene.pov:1:1: error: a polygon has at least three points");
  CHECK(error_line("polygon { 5, 0, x, y, 0 }") ==
        "scene.pov:1:1: error: this polygon does not have as many points as it says");
  CHECK(error_line("polygon { x, y, z }") ==
        "scene.pov:1:11: error: expected 'polygon { count, <point>, ... }', "
        "found a vector as count");
  CHECK_THAT(error_line("polygon { 3, 0, x, y open }"), Catch::Contains("open"));
}

TEST_CASE("polygons in CSG have no inside") {
  const Scene scene = parse("intersection { polygon { 3, 0, x, y inverse } sphere { 0, 1 } }");
  const auto& parts = std::get<std::shared_ptr<const Csg>>(scene.objects.at(0).shape)->parts;
  REQUIRE(parts.size() == 2);
  CHECK_FALSE(parts[0].inverse);
  const std::string asked = "#declare P = polygon { 3, 0, x, y }; #declare Q = object { P inverse };";
  CHECK(parse(asked + "#if (inside(P, -z) | inside(Q, -z) | inside(Q, z)) sphere { 0, 1 } #end")
            .objects.empty());
}

TEST_CASE("every shape takes modifiers and can be declared") {
  const Scene scene = parse("#declare B = box { 0, 1 pigment { rgb 1 } translate x } "
                            "box { B translate y } object { B inverse } object { box { B inverse } inverse } "
                            "cone { B no_shadow }");
  REQUIRE(scene.objects.size() == 4);
  CHECK(scene.objects[0].transform.point({0, 0, 0}) == Vec3(1, 1, 0));
  CHECK_FALSE(scene.objects[0].inverse);
  CHECK(scene.objects[1].inverse);
  CHECK_FALSE(scene.objects[2].inverse);
  CHECK(scene.objects[3].no_shadow);
  CHECK(std::holds_alternative<Box>(scene.objects[3].shape));
}

TEST_CASE("wrong arguments name the shape and what it takes") {
  CHECK(error_line("box { 0 }") ==
        "scene.pov:1:1: error: expected 'box { <corner>, <corner> }', found 1 argument");
  CHECK(error_line("torus { 1, 2, 3 }") ==
        "scene.pov:1:1: error: expected 'torus { major radius, minor radius }', found 3 arguments");
  CHECK(error_line("disc { 0, z }") ==
        "scene.pov:1:1: error: expected 'disc { <centre>, <normal>, radius[, hole "
        "radius] }', found 2 arguments");
  CHECK(error_line("cone { 0, 1, y, z }") ==
        "scene.pov:1:17: error: expected 'cone { <base>, radius, <cap>, radius "
        "[open] }', found a vector as radius");
  CHECK(error_line("cylinder { }") == "scene.pov:1:12: error: unexpected '}', expected a number");
  CHECK(error_line("plane { y, 0, pigment { rgb 1 } }") ==
        "scene.pov:1:15: error: unexpected 'pigment', expected a number");
  CHECK(error_line("box { 0, 1 open }") == "scene.pov:1:1: error: a box cannot be open");
  CHECK(error_line("cylinder { 0, y, 1 scale 2 open }") == "scene.pov:1:28: error: unexpected 'open'");
}

TEST_CASE("degenerate shapes that POV-Ray refuses") {
  CHECK(error_line("plane { 0, 1 }") == "scene.pov:1:1: error: this plane's normal has no direction");
  CHECK(error_line("cylinder { y, y, 1 }") ==
        "scene.pov:1:1: error: this cylinder's ends are the same point");
  CHECK(error_line("cone { y, 1, y, 0 }") == "scene.pov:1:1: error: this cone's ends are the same point");
}

TEST_CASE("what is too large, thin or far away to be seen is left out, and its place said") {
  const auto warning = [](const std::string& object) {
    std::string said;
    ParseOptions options;
    options.message = [&said](std::string_view message) { said += message; };
    const Scene scene = parse("sphere { 0, 1 }\n" + object, options);
    CHECK_NOTHROW(validate(scene));
    CHECK(scene.objects.size() == 1);
    return said;
  };
  const std::string left_out =
      ": warning: this object is too large, too thin or too far away to be seen: it is left out\n";
  for (const char* object :
       {"sphere { 0, 1 translate 1e200*x }", "sphere { 0, 1e200 }", "cylinder { 0, y, 1e-40 }",
        "torus { 1, 0.1 scale 1e-45 }", "mesh { triangle { 0, x, y } scale 1e30 }"})
    CHECK(warning(object) == "scene.pov:2:1" + left_out);
  CHECK_THAT(warning("union { box { 0, 1 } translate 1e100 }"),
             Catch::EndsWith("\nscene.pov:2:9" + left_out));
  // Flat ones are seen, and so is what only looks extreme.
  for (const char* object :
       {"box { 0, <1, 1e-40, 1> }", "box { 0, 1 scale 1e30 }", "disc { 0, y, 1e30 }", "plane { y, -1e15 }",
        "sphere { 1e6, 1e7 }", "cone { 0, 1, y, 0 scale 1e-6 }", "quadric { 1, 0, 0, -1 }"}) {
    CAPTURE(object);
    CHECK(parse(object).objects.size() == 1);
  }
}

TEST_CASE("a part of CSG that is far away leaves nothing or everything of the others") {
  ParseOptions quiet;
  quiet.message = [](std::string_view) {};
  const auto far_part = [&](const std::string& part) {
    const Scene scene = parse("intersection { sphere { 0, 1 } " + part + " }", quiet);
    return std::get<std::shared_ptr<const Csg>>(scene.objects.at(0).shape)->parts.at(1);
  };
  const auto is_point = [](const Object& object) { return std::get<Sphere>(object.shape).radius == 0; };
  const Object beyond = far_part("sphere { 0, 1 translate 1e200*x }"),
               around = far_part("sphere { 0, 1e200 }");
  CHECK((is_point(beyond) && !beyond.inverse));
  CHECK((is_point(around) && around.inverse));
}
