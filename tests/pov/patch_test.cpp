// Bicubic patches. Expected hits and normals are POV-Ray 3.7's.
#include <catch2/catch.hpp>

#include <cmath>

#include "pov/parsing.hpp"

using namespace celltrace;
using test::error_line;
using test::output;
using test::parse;

namespace {

const std::string kPoints = "<-1.45,.29,-1.38>,<-1.32,.29,-.33>,<-1.69,-.04,.68>,<-1.44,.48,1.35>,"
                            "<-.51,-.3,-1.48>,<-.47,-.58,-.61>,<-.59,.5,.61>,<-.64,.36,1.36>,"
                            "<.55,-.45,-1.7>,<.65,-.35,-.61>,<.69,.45,.42>,<.68,.05,1.57>,"
                            "<1.38,.53,-1.42>,<1.69,.47,-.58>,<1.44,-.4,.36>,<1.33,-.24,1.54>";

std::string patch(const std::string& options) {
  return "bicubic_patch { " + options + " " + kPoints;
}

/// Returns where a ray hits and the normal there, with five digits.
std::string trace_patch(const std::string& object, const std::string& ray) {
  return output("#declare O = " + object + " } #declare N = 0; #declare P = trace(O, " + ray +
                ", N); #debug concat(vstr(3, P, \" \", 0, 5), \" facing \", vstr(3, N, \" \", 0, 5))");
}

const Mesh& patch_mesh(const Scene& scene) {
  REQUIRE(scene.objects.size() == 1);
  return *std::get<std::shared_ptr<const Mesh>>(scene.objects[0].shape);
}

std::size_t triangles(const std::string& object) {
  return patch_mesh(parse(object + " }")).triangles.size();
}

} // namespace

TEST_CASE("rays hit the triangles of a bicubic patch where POV-Ray's do") {
  const std::string divided = patch("type 1 flatness 0 u_steps 2 v_steps 2,");
  CHECK(trace_patch(divided, "<5.15,.15,-3.07>, <-4.57,.24,2.2>") ==
        "1.28706 0.35287 -1.21038 facing 0.63946 -0.71317 -0.28719");
  CHECK(trace_patch(divided, "<3.95,-4.29,1.42>, <-3.4,3.56,-1.08>") ==
        "-0.20081 0.05614 0.10151 facing -0.05178 -0.97839 0.20017");
  CHECK(trace_patch(divided, "<-2.11,-2.78,4.88>, <3.29,3.48,-5.34>") ==
        "0.55317 0.03697 0.55742 facing -0.18537 -0.98200 0.03621");
  CHECK(trace_patch(divided, "<2.28,.18,-5.55>, <-3.15,-1.11,4.91>") ==
        "0.00000 0.00000 0.00000 facing 0.00000 0.00000 0.00000");
  const std::string flat = patch("type 1 flatness .01 u_steps 4 v_steps 3");
  CHECK(trace_patch(flat, "<5.15,.15,-3.07>, <-4.57,.24,2.2>") ==
        "1.30280 0.35204 -1.21796 facing 0.66624 -0.70207 -0.25143");
  CHECK(trace_patch(flat, "<1.85,4.92,-2.89>, <-2.82,-5.16,3.87>") ==
        "-0.72632 0.20589 0.64558 facing -0.03806 -0.97505 0.21872");
}

TEST_CASE("a bicubic patch is divided as often as its options say") {
  CHECK(triangles(patch("type 0")) == 2);
  CHECK(triangles(patch("type 1 u_steps 1 v_steps 0")) == 4);
  CHECK(triangles(patch("v_steps 1 type 1 accuracy .1 u_steps 3")) == 2 * 8 * 2);
  CHECK(triangles(patch("type 0 flatness 10 u_steps 3 v_steps 3")) == 2);
  CHECK(triangles(patch("1, 2, 1,")) == 2 * 4 * 2);
  CHECK(triangles(patch("1, 10, 3, 3,")) == 2);
}

TEST_CASE("a patch is as flat as it is where it is placed") {
  const std::string text = patch("type 1 flatness .5 u_steps 3 v_steps 3");
  CHECK(triangles(text + " scale 100") > triangles(text));
  CHECK(triangles(text + " scale .01") == 2);
}

TEST_CASE("surface coordinates of patches go along the rows of control points, or are given") {
  const Scene scene = parse(patch("type 1") + " }");
  const Mesh::Coordinates& own = patch_mesh(scene).coordinates.at(0);
  CHECK(own.corner[1] == Vec2f(1, 0));
  CHECK(own.corner[2] == Vec2f(1, 1));
  const Scene given_scene = parse(patch("type 1 uv_vectors <.1,.2>,<.3,.4>,<.5,.6>,<.7,.8>") + " }");
  const Mesh::Coordinates& given = patch_mesh(given_scene).coordinates.at(1);
  CHECK(given.corner[0] == Vec2f(.1f, .2f));
  CHECK(given.corner[1] == Vec2f(.5f, .6f));
  CHECK(given.corner[2] == Vec2f(.7f, .8f));
}

TEST_CASE("bicubic patches can be named, and nothing clips them") {
  const std::string named = "#declare P = " + patch("type 1") + " } object { P } bicubic_patch { P scale 2 }";
  CHECK(parse(named).objects.size() == 2);
  CHECK_FALSE(parse(patch("type 1") + " clipped_by { box { 5, 6 } } }").objects.at(0).clipped_by);
}

TEST_CASE("bicubic patches with something wrong") {
  CHECK(error_line("bicubic_patch { type 1 0, x, y }") ==
        "scene.pov:1:1: error: a bicubic_patch has 16 control points, found 3");
  CHECK(error_line(patch("u_steps 3") + " }") == "scene.pov:1:1: error: this bicubic_patch needs 'type'");
  CHECK(error_line(patch("type 1") + ", x }") ==
        "scene.pov:1:1: error: a bicubic_patch has 16 control points, found 17");
  CHECK(error_line(patch("type 1") + " flatness 2 }").find("before its control points") != std::string::npos);
  CHECK(error_line(patch("no_shadow type 1") + " }").find("expected an option") != std::string::npos);
  CHECK(error_line(patch("type 1 u_steps 1e9 v_steps 30") + " }").find("triangles") != std::string::npos);
}
