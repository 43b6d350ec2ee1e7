// The camera of the viewer.
#include "viewer/navigator.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include <glm/geometric.hpp>

using namespace celltrace;
using namespace celltrace::viewer;

namespace {

Camera straight() {
  Camera camera;
  camera.location = {0, 0, -10};
  camera.direction = {0, 0, 1};
  camera.right = {4.0 / 3, 0, 0};
  camera.up = {0, 1, 0};
  return camera;
}

Navigator navigator() {
  return {straight(), {-1, -1, -1}, {1, 1, 1}};
}

void check_near(const Vec3& a, const Vec3& b) {
  INFO(a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z);
  CHECK(glm::length(a - b) < 1e-9);
}

/// Axes stay at right angles, and as long as they were.
void check_axes(const Camera& camera, const Camera& before) {
  CHECK(glm::dot(camera.direction, camera.right) == Approx(0).margin(1e-9));
  CHECK(glm::dot(camera.direction, camera.up) == Approx(0).margin(1e-9));
  CHECK(glm::dot(camera.right, camera.up) == Approx(0).margin(1e-9));
  CHECK(glm::length(camera.direction) == Approx(glm::length(before.direction)));
  CHECK(glm::length(camera.right) == Approx(glm::length(before.right)));
  CHECK(glm::length(camera.up) == Approx(glm::length(before.up)));
}

} // namespace

TEST_CASE("Planar, the camera moves in its plane and turns in its place") {
  Navigator n = navigator();
  n.go(1, 0);
  CHECK(n.camera().location.x > 0);
  CHECK(n.camera().location.y == 0);
  CHECK(n.camera().location.z == -10);
  n.go(-1, 2);
  CHECK(n.camera().location.x == Approx(0).margin(1e-9));
  CHECK(n.camera().location.z > -10);
  const Vec3 place = n.camera().location;
  n.turn(90, 0);
  check_near(n.camera().location, place);
  check_near(n.camera().direction, {1, 0, 0});
  n.turn(0, 30);
  CHECK(n.camera().direction.y == Approx(0.5));
  check_axes(n.camera(), straight());
  // Forward stays in the plane, wherever the camera looks.
  n.go(0, 3);
  CHECK(n.camera().location.y == Approx(place.y).margin(1e-9));
  n.rise(2);
  CHECK(n.camera().location.y > place.y);
  n.reset();
  check_near(n.camera().location, straight().location);
  check_near(n.camera().direction, straight().direction);
}

TEST_CASE("Radial, the camera goes around what it looks at") {
  Navigator n = navigator();
  n.set_mode(Navigator::Mode::radial);
  for (int step = 0; step < 40; ++step) {
    n.go(1, step % 3 - 1);
    CHECK(glm::length(n.camera().location) == Approx(10));
    // It goes on looking at the middle.
    const Vec3 towards = glm::normalize(Vec3(0) - n.camera().location);
    check_near(glm::normalize(n.camera().direction), towards);
    check_axes(n.camera(), straight());
  }
  n.reset();
  n.go(1, 0);
  CHECK(n.camera().location.x > 0);
  n.reset();
  n.go(0, 1);
  CHECK(n.camera().location.y > 0);
  // Not over the pole, however long.
  for (int step = 0; step < 100; ++step)
    n.go(0, 1);
  CHECK(n.camera().location.y < 10);
  CHECK(n.camera().location.y > 9.9);
  CHECK(n.camera().up.y > 0);
  n.reset();
  n.rise(5);
  CHECK(glm::length(n.camera().location) > 10);
  for (int step = 0; step < 1000; ++step)
    n.rise(-5);
  CHECK(n.camera().location.z < 0);
}

TEST_CASE("Zooming makes things larger, as cameras can") {
  Navigator planar = navigator();
  planar.zoom(2);
  CHECK(glm::length(planar.camera().direction) == Approx(2));
  Navigator radial = navigator();
  radial.set_mode(Navigator::Mode::radial);
  radial.zoom(2);
  CHECK(glm::length(radial.camera().location) == Approx(5));
  Camera parallel = straight();
  parallel.kind = Camera::Kind::orthographic;
  Navigator orthographic(parallel, {-1, -1, -1}, {1, 1, 1});
  orthographic.zoom(2);
  CHECK(glm::length(orthographic.camera().up) == Approx(0.5));
  Camera fish = straight();
  fish.kind = Camera::Kind::fisheye;
  Navigator fisheye(fish, {-1, -1, -1}, {1, 1, 1});
  fisheye.zoom(2);
  CHECK(fisheye.camera().location.z > -10);
}

TEST_CASE("Views look at the scene from each side") {
  Navigator n(straight(), {-1, -2, 3}, {5, 2, 7});
  for (std::size_t view = 1; view < n.views().size(); ++view) {
    INFO(n.views()[view]);
    n.show_view(view);
    const Camera& camera = n.camera();
    const Vec3 towards = Vec3(2, 0, 5) - camera.location;
    check_near(glm::normalize(towards), glm::normalize(camera.direction));
    CHECK(glm::length(towards) > 4);
    // Left-handed, as POV-Ray's axes.
    check_near(glm::normalize(glm::cross(camera.up, camera.direction)), glm::normalize(camera.right));
  }
  n.show_view(n.views().size());
  CHECK(n.view() == 0);
  check_near(n.camera().location, straight().location);
}

TEST_CASE("Scenes without a size have steps, too") {
  Navigator n(straight(), {0, 0, 0}, {0, 0, 0});
  n.go(1, 0);
  CHECK(n.camera().location.x > 0);
  CHECK(n.camera().location.x < 10);
}

TEST_CASE("Going around keeps what is in the middle there, in any mode") {
  for (const Navigator::Mode mode : {Navigator::Mode::planar, Navigator::Mode::radial}) {
    Navigator n = navigator();
    n.set_mode(mode);
    CHECK(!n.has_pivot());
    n.set_pivot(4);
    CHECK(n.has_pivot());
    const Vec3 pivot(0, 0, -6);
    for (int i = 0; i < 10; ++i) {
      n.orbit(20, i - 5);
      CHECK(glm::length(n.camera().location - pivot) == Approx(4));
      check_near(glm::normalize(pivot - n.camera().location), glm::normalize(n.camera().direction));
    }
    CHECK(n.has_pivot());
    // Looking elsewhere, something else is in the middle.
    const Vec3 place = n.camera().location;
    n.turn(10, 5);
    check_near(n.camera().location, place);
    CHECK(!n.has_pivot());
  }
}

TEST_CASE("Steps are small where the scene is large and what is looked at is near") {
  Navigator large(straight(), {-1000, -1000, -1000}, {1000, 1000, 1000});
  large.set_pivot(5);
  large.walk(0, 1);
  CHECK(large.camera().location.z == Approx(-10 + 0.02 * 2 * 5));
  // A second of a key that is held down, some five steps, leads through a quarter of the scene at most.
  Navigator n = navigator();
  for (int step = 0; step < 6; ++step)
    n.walk(0, 1);
  CHECK(n.camera().location.z < -10 + 0.25 * 2 * std::sqrt(3.0));
}
