// Rules of the language that are easily overlooked. All were seen in POV-Ray 3.7.
#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using namespace celltrace;
using test::error;
using test::error_line;
using test::output;
using test::parse;
using test::value;

namespace {

const Pigment& pigment_of(const Scene& scene) {
  return scene.materials.at(scene.objects.at(0).material).pigment;
}
Pigment entry(const std::string& pigment, std::size_t number) {
  const Scene scene = parse("sphere { 0, 1 pigment { " + pigment + " } }");
  return pigment_of(scene).map->entries.at(number).value;
}
Interior interior(const std::string& text) {
  const Scene scene = parse("#declare I = interior { ior 1.5 fade_distance 2 fade_power 1 } "
                            "#declare M = material { interior { I } }\n" +
                            text);
  return scene.interiors.at(scene.objects.at(0).interior);
}

} // namespace

TEST_CASE("an interior that follows changes the one that is there") {
  for (const char* text : {"sphere { 0, 1 material { M interior { ior 1.1 } } }",
                           "sphere { 0, 1 material { M } interior { ior 1.1 } }",
                           "#declare S = sphere { 0, 1 material { M } } object { S interior { ior 1.1 } }",
                           "sphere { 0, 1 interior { I } interior { ior 1.1 } }"}) {
    INFO(text);
    CHECK(interior(text).ior == 1.1);
    CHECK(interior(text).fade_distance == 2);
  }
  CHECK(interior("#declare J = interior { ior 1.2 } sphere { 0, 1 material { M } interior { J } }")
            .fade_distance == 0);
  CHECK(interior("sphere { 0, 1 interior { ior 1.1 } }").fade_distance == 0);
  // In a finish caustics have another unit than in an interior.
  CHECK(interior("sphere { 0, 1 finish { caustics 9 } }").caustics == Approx(0.2));
}

TEST_CASE("inverse is for a whole transformation, wherever it stands") {
  const auto place = [](const std::string& items) {
    return value(3, "min_extent(object { box { 0, 1 } transform { " + items + " } })");
  };
  CHECK(place("translate x scale 2 inverse") == "-1.00 0.00 0.00");
  CHECK(place("translate x inverse scale 2") == "-1.00 0.00 0.00");
  CHECK(place("inverse translate x scale 2 inverse") == "-1.00 0.00 0.00");
  CHECK(place("transform { translate x inverse } scale 2") == "-2.00 0.00 0.00");
}

TEST_CASE("elements of arrays are passed to macros by reference") {
  const std::string swap = "#macro Swap(A, B) #local C = A; #declare A = B; #declare B = C; #end "
                           "#declare P = array[3] {1, 2, 3} #declare Q = array[2][2] {{1, 2}, {3, 4}} ";
  CHECK(output(swap + "Swap(P[0], P[2]) #debug concat(str(P[0], 0, 0), str(P[1], 0, 0), str(P[2], 0, 0))") ==
        "321");
  CHECK(output(swap + "Swap(Q[0][1], P[1 + 1]) #debug concat(str(Q[0][1], 0, 0), str(P[2], 0, 0))") == "32");
  CHECK(output(swap +
               "#macro Put(A) #declare A = \"x\"; #end #declare E = array[1]; Put(E[0]) #debug E[0]") == "x");
  CHECK(output(swap + "#macro Show(A) #debug str(A, 0, 0) #end Show(P[0] + P[1]) Show(P[1]) Show(P[P[0]])") ==
        "322");
  CHECK(output(swap + "#macro All(A) #declare P[0] = 7; #end All(P[0]) #debug str(P[0], 0, 0)") == "7");
  CHECK(output(swap + "#macro Twice(A) #declare A = 2 * A; #end #macro Four(B) Twice(B) Twice(B) #end "
                      "Four(P[2]) #debug str(P[2], 0, 0)") == "12");
  CHECK(error_line(swap + "Swap(P[3], P[0])").find("subscript 3 is out of range") != std::string::npos);
  CHECK(error_line(swap + "Swap(P[0], P[") != "");
}

TEST_CASE("errors in conditions are where the directive is") {
  CHECK(error_line("sphere { 0, 1 }\n#if (<1, 2>)\n#end") ==
        "scene.pov:2:1: error: expected a float, found a vector");
  CHECK(error_line("sphere { 0, 1 }\n#while (<1, 2>)\n#end") ==
        "scene.pov:2:1: error: expected a float, found a vector");
  CHECK(error_line("sphere { 0, 1 }\n#if (0)\n#elseif (<1, 2>)\n#end") ==
        "scene.pov:3:1: error: expected a float, found a vector");
  CHECK(error_line("sphere { 0, 1 }\n\n#version 4;").substr(0, 15) == "scene.pov:3:1: ");
}

TEST_CASE("in functions & binds tighter than |") {
  CHECK(output("#declare F = function(x, y, z) {x | y & z} #debug str(F(1, 0, 0), 0, 0)") == "1");
  CHECK(output("#declare F = function(x, y, z) {x & y | z} #debug str(F(0, 0, 1), 0, 0)") == "1");
  CHECK(value("(1 | 0 & 0)") == "0.000");
}

TEST_CASE("only Mandelbrot's own fractal has colours by itself") {
  CHECK(entry("mandel 9", 1).rgb != Vec3(1));
  for (const char* fractal :
       {"mandel 9 exponent 3", "julia <0.3, 0.4>, 9", "magnet 1 mandel 9", "magnet 2 julia <0.3, 0.4>, 9"}) {
    INFO(fractal);
    CHECK(entry(fractal, 0).rgb == Vec3(0));
    CHECK(entry(fractal, 1).rgb == Vec3(1));
  }
}

TEST_CASE("maps whose positions do not ascend begin where the entry before is") {
  // From 0.5 on the line from the second entry to the third is seen.
  const std::string map = "gradient x color_map { [0.5 rgb x] [0.3 rgb y] [1 rgb z] }";
  CHECK(entry(map, 0).rgb == Vec3(1, 0, 0));
  CHECK(entry(map, 1).rgb.y == Approx(5.0 / 7));
  CHECK(entry(map, 1).rgb.z == Approx(2.0 / 7));
  CHECK(entry(map, 2).rgb == Vec3(0, 0, 1));
  // What lies beyond the last entry is seen as far as that.
  CHECK(entry("gradient x color_map { [0 rgb 0] [2 rgb 1] [1 rgb x] }", 1).rgb == Vec3(0.5));
  CHECK(entry("gradient x color_map { [0 rgb 0] [0.5 rgb 1] [1 rgb x] }", 1).rgb == Vec3(1));
}

TEST_CASE("patterns take what POV-Ray takes") {
  for (const char* pigment : {"checker warp { black_hole <1, 2, 3> 0.5 }", "checker warp { planar z 0.5 }",
                              "average pigment_map { [2 rgb 1] [-1 rgb x] }"}) {
    INFO(pigment);
    CHECK(error("sphere { 0, 1 pigment { " + std::string(pigment) + " } }").empty());
  }
  const auto repeat = [](const std::string& hole) {
    const Scene scene = parse("sphere { 0, 1 pigment { checker warp { black_hole 0, 1 " + hole + " } } }");
    return std::get<warp::BlackHole>(pigment_of(scene).map->pattern.space.at(0)).repeat;
  };
  CHECK(repeat("repeat <1, 3, 0> turbulence <0.5, 2, 2>") == Vec3(2.5, 4, 0));
  CHECK(repeat("repeat <5, 5, 5>") == Vec3(5));
}

TEST_CASE("quick_color counts in pictures of low quality") {
  const auto colour = [](int quality) {
    ParseOptions options;
    options.quality = quality;
    return pigment_of(parse("sphere { 0, 1 pigment { rgb x quick_color rgb y } }", options)).rgb;
  };
  CHECK(colour(5) == Vec3(0, 1, 0));
  CHECK(colour(6) == Vec3(1, 0, 0));
}

TEST_CASE("normals that are zero lie along x in meshes, and leave a triangle out that stands alone") {
  const std::string corners = "0, 0, x, <0, 1, 2>, y, <0, 1, 2> ";
  const Scene scene = parse("mesh { smooth_triangle { " + corners + " } }");
  const Mesh& mesh = *std::get<std::shared_ptr<const Mesh>>(scene.objects.at(0).shape);
  REQUIRE(mesh.normals.size() == 3);
  CHECK(mesh.normals[0] == Vec3f(1, 0, 0));
  CHECK(parse("smooth_triangle { " + corners + " }").objects.empty());
  CHECK(parse("smooth_triangle { 0, z, x, <0, 1, -2>, y, <0, 1, 2> }").objects.empty());
  CHECK(parse("smooth_triangle { 0, z, x, <0, 1, 2>, y, <0, 1, 2> }").objects.size() == 1);
}

TEST_CASE("a comma may stand where a disc's hole would") {
  const Scene scene =
      parse("disc { y, y, 3, pigment { rgb 1 } } disc { y, y, 3 rotate x } #for (I, 1, 2) disc { y, y, "
            "I, pigment { rgb I } } #end");
  REQUIRE(scene.objects.size() == 4);
  CHECK(std::get<Disc>(scene.objects[0].shape).hole_radius == 0);
  CHECK(std::get<Disc>(scene.objects[3].shape).radius == 2);
  CHECK(error_line("disc { y, y, 3, 1, pigment { rgb 1 } }") == "scene.pov:1:18: error: unexpected ','");
  CHECK(error_line("sphere { 0, 1, pigment { rgb 1 } }") ==
        "scene.pov:1:16: error: unexpected 'pigment', expected a number");
}

TEST_CASE("subscripts in a macro's arguments may call macros") {
  const std::string macros =
      "#declare A = array[4] { 3, 2, 1, 0 } #macro Mod4(N) #local M = mod(N, 4); #if (M < 0) #local M = M + "
      "4; "
      "#end M #end #macro Pass(W, C, P) Mod4(W[Mod4(C + P)] - P) #end #macro Twice(X) (2 * X) #end ";
  CHECK(output(macros + "#declare C = 2; #declare C = Pass(A, C, 1); #debug str(C, 0, 0)") == "3");
  CHECK(output(macros + "#debug str(Twice(A[Mod4(5)] + A[Mod4(A[Mod4(-1)])]), 0, 0)") == "10");
  CHECK(output(macros + "#for (I, 0, 3) #debug str(Pass(A, A[Mod4(I)], 2), 0, 0) #end") == "0123");
  CHECK(output("#macro Set(X) #declare X = 7; #end #macro One() 1 #end #declare A = array[2] { 0, 0 } "
               "Set(A[One()]) #debug concat(str(A[0], 0, 0), str(A[1], 0, 0))") == "07");
}

TEST_CASE("trace() finds a torus from its middle outwards") {
  CHECK(value(3, "trace(torus { 0.6, 0.25 }, <5, 0, 0>, -x)") == "0.85 0.00 0.00");
  CHECK(value(3, "trace(torus { 0.6, 0.25 }, <0, 0, -5>, z)") == "0.00 0.00 -0.85");
}

TEST_CASE("what mirrors see of a background that is clear") {
  CHECK_FALSE(parse("background { rgb 1 } sphere { 0, 1 }").mirrored_background);
  const Scene scene = parse("#version 3.7; background { rgbt <1, 0.5, 0, 0.25> } sphere { 0, 1 }");
  CHECK(scene.background == Vec3(0.75, 0.375, 0));
  CHECK(scene.mirrored_background == Vec3(1, 0.5, 0));
}

TEST_CASE("a light without a colour is black") {
  CHECK(parse("light_source { <1, 2, 3> }").lights.at(0).colour == Vec3(0));
  CHECK(parse("light_source { <1, 2, 3> spotlight point_at 0 }").lights.at(0).colour == Vec3(0));
  CHECK(parse("light_source { y, 0.5 }").lights.at(0).colour == Vec3(0.5));
}

TEST_CASE("an interior_texture is that of a mesh's own textures, too") {
  const Scene scene =
      parse("#declare M = mesh2 { vertex_vectors { 4, 0, x, y, z } texture_list { 2, texture { "
            "pigment { rgb x } }, texture { pigment { rgb 3 } } } face_indices { 3, <0, 1, 2>, 0, <1, 2, 3>, "
            "<0, 1, 3>, 1 } } "
            "#declare I = texture { pigment { rgb z } } #declare T = texture { pigment { rgb y } } "
            "object { M texture { T } interior_texture { I } } object { M texture { T } } "
            "object { M texture { T } interior_texture { I } translate x }");
  const auto mesh = [&](std::size_t i) {
    return std::get<std::shared_ptr<const Mesh>>(scene.objects.at(i).shape);
  };
  const auto own = [&](std::size_t i, std::size_t triangle = 0) {
    return scene.materials.at(mesh(i)->triangles.at(triangle).material[0]);
  };
  for (const std::size_t triangle : {0, 2}) {
    REQUIRE(own(0, triangle).inside);
    CHECK(own(0, triangle).inside->pigment.rgb == Vec3(0, 0, 1));
    CHECK(own(0, triangle).pigment.rgb == (triangle == 0 ? Vec3(1, 0, 0) : Vec3(3)));
  }
  CHECK(mesh(0)->triangles.at(1).material[0] == kNoIndex);
  CHECK_FALSE(own(1).inside);
  CHECK(mesh(0) == mesh(2));
}
