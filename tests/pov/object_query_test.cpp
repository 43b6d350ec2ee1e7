// trace(), inside(), min_extent() and max_extent(). Expected numbers are POV-Ray 3.7's.
#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using namespace celltrace;
using test::output;

namespace {

const std::string kObjects = "#declare S = sphere { <1,2,3>, 2 } #declare B = box { <1,2,3>, <0,5,1> } ";

std::string extents(const std::string& object) {
  return output(
      kObjects + "#declare O = " + object +
      " #debug concat(vstr(3, min_extent(O), \" \", 0, 4), \" to \", vstr(3, max_extent(O), \" \", 0, 4))");
}

/// Where a ray hits and the normal there.
std::string hit(const std::string& object, const std::string& ray) {
  return output(kObjects + "#declare O = " + object + " #declare N = 9; #declare P = trace(O, " + ray +
                ", N); #debug concat(vstr(3, P, \" \", 0, 4), \" facing \", vstr(3, N, \" \", 0, 4))");
}

} // namespace

TEST_CASE("the extents of shapes") {
  CHECK(extents("S") == "-1.0000 0.0000 1.0000 to 3.0000 4.0000 5.0000");
  CHECK(extents("object { S rotate 30 scale <1,2,3> }") == "0.1920 -0.9330 1.8481 to 4.1920 7.0670 13.8481");
  CHECK(extents("object { S scale <1,2,3> rotate 30 }") ==
        "-0.6071 -3.6806 0.7500 to 11.6250 7.6495 15.2141");
  CHECK(extents("object { B rotate <10,20,30> }") == "-1.8263 1.7832 0.9097 to 1.0674 4.9368 3.5921");
  CHECK(extents("cylinder { 0, <1,2,3>, .5 }") == "-0.6802 -0.5811 -0.4009 to 1.6802 2.5811 3.4009");
  CHECK(extents("cone { 0, 1, <1,2,3>, .5 }") == "-1.3604 -1.1621 -0.8018 to 2.3604 3.1621 3.8018");
  CHECK(extents("cylinder { <1,1,1>, <2,3,4>, .5 rotate 30*z }") ==
        "-0.4268 0.8425 0.5991 to 1.0249 4.1216 4.4009");
  CHECK(extents("cone { <1,1,1>, .3, <2,3,4>, .5 rotate 30*z }") ==
        "-0.4483 0.8157 0.5991 to 1.0464 4.1484 4.4009");
  CHECK(extents("cone { <1,1,1>, .7, <-2,-3,-4>, .6 rotate <20,30,40> }") ==
        "-3.0805 -4.4191 -3.8323 to 1.6239 2.0828 1.2985");
  CHECK(extents("triangle { z, x, y rotate 30*z }") == "-0.5000 0.0000 0.0000 to 0.8660 0.8660 1.0000");
  CHECK(extents("disc { <1,2,3>, <1,1,0>, 2, 1 }") == "-1.0007 -0.0007 0.1716 to 3.0007 4.0007 5.8284");
  CHECK(extents("torus { 2, .5 rotate x*45 }") == "-2.5000 -2.1213 -2.1213 to 2.5000 2.1213 2.1213");
  CHECK(extents("quadric { 1, 0, 0, -1 }") == "-1.0000 -1.0000 -1.0000 to 1.0000 1.0000 1.0000");
  CHECK(extents("superellipsoid { <.25, .5> rotate 30 }") ==
        "-1.5917 -1.5247 -1.6832 to 1.5917 1.5247 1.6832");
  CHECK(extents("mesh { triangle { 0, x, y } triangle { 0, y, z } }") ==
        "0.0000 0.0000 0.0000 to 1.0000 1.0000 1.0000");
  CHECK(extents("plane { y, 1 }") == "-10000000000.0000 -10000000000.0000 -10000000000.0000 to "
                                     "10000000000.0000 10000000000.0000 10000000000.0000");
}

TEST_CASE("the extents of CSG") {
  CHECK(extents("union { object { S } object { B } }") == "-1.0000 0.0000 1.0000 to 3.0000 5.0000 5.0000");
  CHECK(extents("intersection { object { S } object { B } rotate 45 }") ==
        "0.2678 1.2678 0.7929 to 2.7678 3.7678 3.5000");
  CHECK(extents("difference { object { S } object { B } }") ==
        "-1.0000 0.0000 1.0000 to 3.0000 4.0000 5.0000");
  CHECK(extents("intersection { object { S } plane { y, 2 } }") ==
        "-1.0000 0.0000 1.0000 to 3.0000 2.0000 5.0000");
  CHECK(extents("difference { object { S } plane { y, 2 inverse } }") ==
        "-1.0000 0.0000 1.0000 to 3.0000 2.0000 5.0000");
  CHECK(extents("object { S clipped_by { B } }") == "0.0000 2.0000 1.0000 to 1.0000 5.0000 3.0000");
  CHECK(extents("union { sphere { 0, 1 } sphere { x*3, 1 } rotate z*45 }") ==
        "-1.4142 -1.4142 -1.0000 to 3.5355 3.5355 1.0000");
}

TEST_CASE("tracing shapes") {
  CHECK(hit("S", "<0,0,-10>, z*5 + x*.2 + y") == "0.4437 2.2183 1.0914 facing -0.2782 0.1091 -0.9543");
  CHECK(hit("S", "<1,2,3>, z") == "1.0000 2.0000 5.0000 facing 0.0000 0.0000 1.0000");
  CHECK(hit("object { B rotate <10,20,30> }", "<.5,3,-10>, z") ==
        "0.5000 3.0000 2.3871 facing 0.8138 0.4698 -0.3420");
  CHECK(hit("B", "<.5,3,1>, z") == "0.5000 3.0000 3.0000 facing 0.0000 0.0000 1.0000"); // starts on it
  CHECK(hit("B", "<10,3,1>, z") == "0.0000 0.0000 0.0000 facing 0.0000 0.0000 0.0000");
  CHECK(hit("object { B inverse }", "<.5,3,-10>, z") == "0.5000 3.0000 1.0000 facing 0.0000 0.0000 1.0000");
  CHECK(hit("cylinder { 0, <1,2,3>, .5 }", "<0.1,.2,-10>, z") ==
        "0.1000 0.2000 -0.1667 facing -0.2673 -0.5345 -0.8018");
  CHECK(hit("cone { 0, 0, <0,2,0>, .5 }", "<0.1,1,-10>, z") ==
        "0.1000 1.0000 -0.2291 facing 0.3881 -0.2425 -0.8892");
  CHECK(hit("plane { y, 1 }", "<0,-5,0>, y") == "0.0000 1.0000 0.0000 facing 0.0000 1.0000 0.0000");
  CHECK(hit("disc { <1,2,3>, y, 2, 1 }", "<2.5,-10,3>, y") ==
        "2.5000 2.0000 3.0000 facing 0.0000 1.0000 0.0000");
  CHECK(hit("torus { 2, .5 }", "<2,5,0.1>, -y") == "2.0000 0.5000 0.1000 facing 0.0050 1.0000 0.0002");
  CHECK(hit("torus { 2, .5 }", "<2,0,0>, -y") == "2.0000 -0.5000 0.0000 facing 0.0000 -1.0000 0.0000");
  CHECK(hit("quadric { 1, 0, 0, -1 }", "-z*3, z + x*.1") ==
        "0.2021 0.0000 -0.9794 facing 0.2021 0.0000 -0.9794");
  CHECK(hit("superellipsoid { <.25, .5> }", "<.99,.6,-5>, z") ==
        "0.9900 0.6000 -0.4186 facing 0.9967 0.0299 -0.0760");
  CHECK(hit("superellipsoid { <1, .1> }", "<-5,.4,.5>, x") ==
        "-0.9165 0.4000 0.5000 facing -0.9165 0.4000 0.0000");
  CHECK(hit("superellipsoid { <4, 3> }", "<-2,.95,.01>, <3,-1,0>") ==
        "-0.1502 0.3334 0.0100 facing -0.4581 0.3075 0.8340");
  CHECK(hit("cylinder { -y, y, -1 }", "<.3,10,.2>, -y") ==
        "0.3000 1.0000 0.2000 facing 0.0000 1.0000 0.0000");
  CHECK(hit("disc { 0, y, -1, .2 }", "<.3,10,.2>, -y") == "0.3000 0.0000 0.2000 facing 0.0000 1.0000 0.0000");
  CHECK(hit("triangle { 0, x, y }", "<.2,.2,1>, -z") == "0.2000 0.2000 0.0000 facing 0.0000 0.0000 -1.0000");
}

TEST_CASE("tracing CSG and meshes, placed or not") {
  CHECK(hit("intersection { object { S } object { B } }", "<.5,3,-10>, z") ==
        "0.5000 3.0000 1.3417 facing -0.2500 0.5000 -0.8292");
  CHECK(hit("difference { object { S } object { B } }", "<.5,3,-10>, z") ==
        "0.5000 3.0000 3.0000 facing 0.0000 0.0000 -1.0000");
  CHECK(hit("object { S clipped_by { B } }", "<.5,3,-10>, z") ==
        "0.5000 3.0000 1.3417 facing -0.2500 0.5000 -0.8292");
  const std::string mesh = "mesh { triangle { 0, x, y } triangle { 0, y, z } }";
  const std::string expected = "0.2000 0.2000 0.0000 facing 0.0000 0.0000 -1.0000";
  CHECK(hit(mesh, "<.2,.2,-1>, z") == expected);
  CHECK(hit(mesh + " object { O }", "<.2,.2,-1>, z") == expected);
}

TEST_CASE("a mesh is hit where its triangles are, however many") {
  const std::string scene =
      "#declare R = seed(3); #macro V() <rand(R), rand(R), rand(R)> * 20 #end "
      "#declare A = array[900] #for (I, 0, 899, 3) #local P = V(); #declare A[I] = P; "
      "#declare A[I + 1] = P + V() / 4; #declare A[I + 2] = P + V() / 4; #end "
      "#macro All() #for (I, 0, 899, 3) triangle { A[I], A[I + 1], A[I + 2] } #end #end "
      "#declare M = mesh { All() inside_vector y } #declare U = union { All() } "
      "#declare Hits = 0; #declare Differ = 0; #declare Inside = 0; #for (I, 0, 999) "
      "#local N = <0, 0, 0>; #local L = <0, 0, 0>; #local From = V() * 2 - 10; #local To = V() - From; "
      "#local P = trace(M, From, To, N); #local Q = trace(U, From, To, L); "
      "#if (vlength(L) > 0) #declare Hits = Hits + 1; #end "
      "#if (vlength(P - Q) > 1e-4 | vlength(N - L) > 1e-4) #declare Differ = Differ + 1; #end "
      // As often as the ray of the mesh meets one of them.
      "#declare P = V(); #declare Odd = 0; #declare Ray = P; #declare Far = 0; "
      "#while (!Far) #declare Ray = trace(U, Ray, y, N); #if (vlength(N) = 0) #declare Far = 1; "
      "#else #declare Odd = !Odd; #declare N = <0, 0, 0>; #end #end "
      "#if (Odd != inside(M, P)) #declare Differ = Differ + 1; #end "
      "#if (Odd) #declare Inside = Inside + 1; #end #end ";
  CHECK(output(scene + "#debug str(Differ, 0, 0)") == "0");
  CHECK(output(scene + "#debug str(Hits > 500 & Inside > 200, 0, 0)") == "1");
}

TEST_CASE("what is inside") {
  const auto inside = [](const std::string& what) {
    return output(kObjects + "#debug str(inside(" + what + "), 0, 0)");
  };
  CHECK(inside("S, <1,2,3>") == "1");
  CHECK(inside("S, <1,2,5.1>") == "0");
  CHECK(inside("cylinder { -y, y, -1 }, <.3,.4,.1>") == "1");
  CHECK(inside("superellipsoid { <4, 3> }, .1") == "1");
  CHECK(inside("superellipsoid { <4, 3> }, .2") == "0");
  CHECK(inside("object { B inverse }, 0") == "1");
  CHECK(inside("difference { object { S } object { B } }, <0.5,3,2>") == "0");
}

TEST_CASE("asking what is not supported is using it") {
  CHECK(test::error_line("#declare T = julia_fractal { 0 } #declare E = max_extent(T);") ==
        "scene.pov:1:14: error: 'julia_fractal' is not supported yet");
}
