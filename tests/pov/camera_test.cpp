// The camera's finished vectors. Every case was checked against POV-Ray 3.7's pictures of small spheres: the
// camera given here puts them into the same place to within half a pixel.
#include <cmath>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "pov/parsing.hpp"

using celltrace::Camera;
using celltrace::Vec3;
using celltrace::test::error_line;
using celltrace::test::parse;

namespace {

Camera camera(const std::string& fields) {
  return parse("camera { " + fields + " }").camera;
}

bool near(const Vec3& a, const Vec3& b) {
  return glm::length(a - b) < 5e-4;
}

} // namespace

TEST_CASE("the default camera") {
  const Camera c = parse("background { rgb 1 }").camera;
  CHECK(c.kind == Camera::Kind::perspective);
  CHECK(near(c.location, {0, 0, 0}));
  CHECK(near(c.direction, {0, 0, 1}));
  CHECK(near(c.right, {1.33, 0, 0}));
  CHECK(near(c.up, {0, 1, 0}));
}

TEST_CASE("look_at turns, angle sets the distance") {
  const Camera c = camera("angle 38 look_at <0, -0.05, 0> location <1.6, 1.2, -3.2>");
  CHECK(near(c.direction, {-0.815, -0.637, 1.631}));
  CHECK(near(c.right, {1.190, 0, 0.595}));
  CHECK(near(c.up, {-0.148, 0.944, 0.295}));
}

TEST_CASE("fields apply in a fixed order, whatever the text's") {
  const Camera a = camera("location <3, 2, -5> right 1.5*x up y*1.2 angle 60 look_at 0");
  const Camera b = camera("look_at 0 angle 60 up y*1.2 right 1.5*x location <3, 2, -5>");
  CHECK(near(a.direction, b.direction));
  CHECK(near(a.right, b.right));
  CHECK(glm::length(a.right) == Approx(1.5));
  CHECK(glm::length(a.up) == Approx(1.2));
  CHECK(glm::length(a.direction) == Approx(1.5 / (2 * std::tan(3.14159265358979 / 6))));
}

TEST_CASE("handedness comes from right, up and direction as given") {
  CHECK(near(camera("location -5*z right -4/3*x look_at 0").right, {-4.0 / 3, 0, 0}));
  // With z up the default direction is parallel to up: POV-Ray then mirrors.
  CHECK(near(camera("up z right 1.33*x sky z location <0, -6, 0> look_at 0").right, {1.33, 0, 0}));
  CHECK(near(camera("up z right -1.33*x sky z location <0, -6, 0> look_at 0").right, {1.33, 0, 0}));
  CHECK(near(camera("right -1.33*x sky z location <0, -6, 0> look_at 0").right, {1.33, 0, 0}));
}

TEST_CASE("looking along the sky keeps the given right") {
  const Camera c = camera("location 5*y look_at 0");
  CHECK(near(c.direction, {0, -1, 0}));
  CHECK(near(c.right, {1.33, 0, 0}));
  CHECK(near(c.up, {0, 0, 1}));
}

TEST_CASE("orthographic cameras are scaled unless they have a size of their own") {
  const auto width = [](const char* fields) { return glm::length(camera(fields).right); };
  CHECK(camera("orthographic").kind == Camera::Kind::orthographic);
  CHECK(width("orthographic location -5*z look_at 0") == Approx(1.33 * 5));
  CHECK(width("orthographic location -5*z look_at 0 right 6*x") == Approx(6));
  CHECK(width("orthographic location -5*z look_at 0 direction 2*z") == Approx(1.33 * 2.5));
  CHECK(width("orthographic location -5*z look_at 0 angle 90 right 2*x") == Approx(10));
  CHECK(width("orthographic location -5*z look_at 0 angle 0 right 2*x") == Approx(10));
  CHECK(width("orthographic location -5*z look_at 0 angle right 2*x") == Approx(10));
  CHECK(width("orthographic angle location -5*z look_at 0 rotate 10*y") == Approx(1.33 * 5));
}

TEST_CASE("transformations come last") {
  const Camera c = camera("location -5*z rotate 90*y translate <0, 1, 0> look_at 0");
  CHECK(near(c.location, {-5, 1, 0}));
  CHECK(near(c.direction, {1, 0, 0}));
  CHECK(near(c.right, {0, 0, -1.33}));
}

TEST_CASE("the last camera is the scene's") {
  const auto scene =
      parse("camera { mesh_camera { 1, 0 } } #declare C = camera { location x } camera { C location 2*x }");
  CHECK(near(scene.camera.location, {2, 0, 0}));
}

TEST_CASE("cameras that cannot be") {
  CHECK(error_line("camera { angle 180 }") ==
        "scene.pov:1:1: error: a camera's angle must lie between 0 and 180 degrees");
  CHECK(error_line("camera { location x look_at x }") ==
        "scene.pov:1:1: error: the camera's 'location' and 'look_at' are the same point");
  CHECK_FALSE(error_line("camera { look_at 9e-6 * z translate x }").empty());
  CHECK_FALSE(error_line("#declare C = camera { location x look_at x }").empty());
  CHECK(error_line("camera { look_at 1.1e-5 * z }").empty());
  CHECK(error_line("camera { location x look_at x location y }").empty());
  CHECK(error_line("camera { aperture 0.4 blur_samples 10 }") ==
        "scene.pov:1:10: error: 'aperture' is not supported yet");
  CHECK_FALSE(error_line("camera { blur_samples 4, 10 aperture 0.4 }").empty());
}

TEST_CASE("focal blur takes an aperture and samples") {
  for (const char* none : {"aperture 0.4", "blur_samples 10", "aperture 0 blur_samples 4, 10",
                           "aperture 0.4 blur_samples 10 aperture 0"})
    CHECK(error_line("camera { " + std::string(none) + " focal_point 0 }").empty());
}

TEST_CASE("an orthographic camera has the size of right and up before version 3.5") {
  const std::string scene = "camera { orthographic location -5 * z look_at 0 angle 30 }";
  CHECK(parse("#version 3.1; " + scene).camera.right.x == Approx(1.33));
  CHECK(parse("#version 3.5; " + scene).camera.right.x > 2);
}

TEST_CASE("before version 3.5 each field acts on what is there") {
  const auto old = [](const std::string& fields) {
    return parse("#version 3.1; camera { " + fields + " }").camera;
  };
  const Camera plain = old("location -5*z");
  // Turned to the point as seen from the origin, which is where the camera still was.
  CHECK(near(old("look_at x location -5*z").direction, {1, 0, 0}));
  CHECK(near(old("look_at x location -5*z").location, {0, 0, -5}));
  CHECK(near(old("location -5*z look_at 0 sky x").up, plain.up));
  CHECK(near(old("location -5*z sky x look_at 0").up, {1, 0, 0}));
  CHECK(near(old("location -5*x look_at 0 direction 2*z").direction, {0, 0, 2}));
  CHECK(near(old("location -5*x look_at 0 right 2*x").right, {2, 0, 0}));
  const double depth = 1.33 / (2 * std::tan(3.14159265358979 / 6));
  CHECK(near(old("angle 60 right 3*x").direction, {0, 0, depth}));
  CHECK(near(old("right 3*x angle 60").direction, {0, 0, depth * 3 / 1.33}));
  CHECK(near(old("angle 60 direction 2*z").direction, {0, 0, 2}));
  CHECK(near(old("location -5*x look_at 0 angle 60").direction, {depth, 0, 0}));
  const Camera moved = old("translate y rotate 90*y location -5*x");
  CHECK(near(moved.location, {-5, 0, 0}));
  CHECK(near(moved.direction, {1, 0, 0}));
  CHECK(near(moved.right, {0, 0, -1.33}));
  CHECK(near(old("rotate 90*y location -5*z look_at 0").direction, {0, 0, 1}));
}

TEST_CASE("before version 3.5 the kind of a camera may come late") {
  const auto late = [](const std::string& kind) {
    return parse("#version 3.1; camera { angle 60 " + kind + " }").camera;
  };
  CHECK(late("orthographic").kind == Camera::Kind::orthographic);
  // It takes the size that the picture has at the point which is looked at, or would be.
  CHECK(late("orthographic").right.x == Approx(2 * std::tan(3.14159265358979 / 6)));
  CHECK(
      near(late("location -5*z look_at 0 orthographic").right, {10 * std::tan(3.14159265358979 / 6), 0, 0}));
  CHECK(near(late("orthographic location -5*z look_at 0").right, {2 * std::tan(3.14159265358979 / 6), 0, 0}));
  CHECK(late("fisheye").angle == 60);
}

TEST_CASE("the version that a camera is read by is the one in front of it") {
  CHECK(near(parse("camera { look_at x location -5*x } #version 3.1;").camera.direction, {1, 0, 0}));
  CHECK(near(parse("#version 3.1; camera { location -5*z look_at 0 sky x } #version 3.7;").camera.up,
             {0, 1, 0}));
  // POV-Ray counts versions in hundredths.
  CHECK(near(parse("#version 3.494; camera { look_at x location z }").camera.direction, {1, 0, 0}));
  CHECK(near(parse("#version 3.496; camera { look_at x location 2*x }").camera.direction, {-1, 0, 0}));
}

TEST_CASE("what a declared camera is followed by acts on it before version 3.5") {
  const std::string declared = "camera { look_at <1, 0, 1> angle 90 location -z }";
  const auto used = [&](const std::string& before, const std::string& after) {
    return parse("#version " + before + "; #declare C = " + declared + " #version 3.1; camera { C " + after +
                 " }")
        .camera;
  };
  const double half = std::sqrt(0.5) * 0.665;
  CHECK(near(used("3.1", "location 2*y").location, {0, 2, 0}));
  CHECK(near(used("3.1", "location 2*y").direction, {half, 0, half}));
  CHECK(near(used("3.1", "rotate -45*y").direction, {0, 0, 0.665}));
  // It was finished where it was declared.
  CHECK(glm::length(used("3.7", "location 2*y").direction - 0.665 * glm::normalize(Vec3(1, 0, 2))) < 5e-4);
  CHECK(near(
      parse("#version 3.1; #declare C = camera { location -5*z look_at 0 sky x } #version 3.7; camera { C }")
          .camera.up,
      {0, 1, 0}));
}

TEST_CASE("cameras that cannot be before version 3.5") {
  CHECK(error_line("#version 3.1; camera { angle 180 }") ==
        "scene.pov:1:24: error: a camera's angle must lie between 0 and 180 degrees");
  CHECK(error_line("#declare C = camera { angle 180 } #version 3.1; camera { C }") ==
        "scene.pov:1:58: error: a camera's angle must lie between 0 and 180 degrees");
}

TEST_CASE("kinds of cameras by their words") {
  using Kind = Camera::Kind;
  CHECK(camera("perspective").kind == Kind::perspective);
  CHECK(camera("spherical").kind == Kind::spherical);
  CHECK(camera("ultra_wide_angle").kind == Kind::ultra_wide_angle);
  CHECK(camera("omnimax").kind == Kind::omnimax);
  CHECK(camera("panoramic").kind == Kind::panoramic);
  CHECK(camera("cylinder 1").kind == Kind::cylinder_1);
  CHECK(camera("cylinder 2").kind == Kind::cylinder_2);
  CHECK(camera("cylinder 3.9 angle 20").kind == Kind::cylinder_3);
  CHECK(camera("cylinder 4").kind == Kind::cylinder_4);
  CHECK(camera("fisheye").kind == Kind::fisheye);
  CHECK(camera("spherical perspective").kind == Kind::perspective);
}

TEST_CASE("the angles of cameras whose pictures are not flat") {
  CHECK(camera("ultra_wide_angle").angle == 90);
  const Camera wide = camera("ultra_wide_angle angle 300 direction 2*z");
  CHECK(wide.angle == 300);
  CHECK(near(wide.direction, {0, 0, 2}));
  CHECK(camera("cylinder 1 angle 0").angle == 0);
  const Camera all_round = camera("spherical");
  CHECK(all_round.angle == 360);
  CHECK(all_round.vertical_angle == 180);
  CHECK(camera("spherical angle 120").vertical_angle == 60);
  const Camera both = camera("spherical angle 120 90 location x");
  CHECK(both.angle == 120);
  CHECK(both.vertical_angle == 90);
  CHECK(both.location == Vec3(1, 0, 0));
  CHECK(camera("spherical angle 120, 90").vertical_angle == 90);
  CHECK(camera("spherical angle 120, 90 angle 100").vertical_angle == 50);
  CHECK(near(camera("spherical right -x look_at x").right, {0, 0, 1}));
}

TEST_CASE("what cameras of other kinds cannot have") {
  const auto refusal = [](const std::string& fields) { return error_line("camera { " + fields + " }"); };
  CHECK(refusal("ultra_wide_angle angle 100, 50") ==
        "scene.pov:1:38: error: only a spherical camera has a second angle");
  CHECK(refusal("cylinder 5") == "scene.pov:1:10: error: cameras on a cylinder are of type 1, 2, 3 or 4");
  CHECK(refusal("cylinder 0") == "scene.pov:1:10: error: cameras on a cylinder are of type 1, 2, 3 or 4");
  CHECK(refusal("sphere 1") == "scene.pov:1:10: error: there is no camera of this shape");
  CHECK(refusal("spherical angle -5") == "scene.pov:1:1: error: a camera's angle must not be negative");
  CHECK(refusal("spherical angle 5, -5") == "scene.pov:1:1: error: a camera's angle must not be negative");
  CHECK(refusal("mesh_camera { 1, 0 }") == "scene.pov:1:10: error: 'mesh_camera' is not supported yet");
  CHECK(refusal("onion") == "scene.pov:1:10: error: there is no camera of this kind");
}
