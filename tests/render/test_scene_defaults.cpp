// What of a scene need not be said, or is said in another way: a camera by where it looks, objects without an
// interior.
#include "celltrace/error.hpp"
#include "render/backends.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

using namespace celltrace;
using namespace celltrace::test;

namespace {

/// Glass, so that insides count.
Scene two_balls() {
  Scene scene;
  scene.camera = Camera::look_at({0, 1, -6}, {0, 0, 0}, 50, 4.0 / 3);
  Light light;
  light.location = {3, 5, -4};
  scene.lights.push_back(light);
  Material glass;
  glass.pigment.transmit = 0.8;
  const Index material = scene.add(glass);
  for (const double x : {-1.0, 0.5}) {
    Object object;
    object.shape = Sphere{{x, 0, 0}, 1};
    object.material = material;
    scene.objects.push_back(object);
  }
  return scene;
}

} // namespace

TEST_CASE("objects without an interior have one as Interior() makes it") {
  Scene scene = two_balls();
  Fog fog;
  fog.colour = {0.5, 0.6, 0.7};
  fog.distance = 8;
  scene.fogs.push_back(fog);
  Scene explicitly = scene;
  for (Object& object : explicitly.objects)
    object.interior = explicitly.add(Interior());
  // In one of them the camera is, which has to be known of.
  scene.camera.location = explicitly.camera.location = {-1, 0, 0};
  for (const TestBackend& backend : backends()) {
    INFO(backend.spu());
    const RenderOptions options = backend.options(pixels(48), pixels(36), 2);
    CHECK(render(scene, options).image == render(explicitly, options).image);
  }
  // Beside ones that have another.
  Interior dense;
  dense.ior = 1.5;
  scene.objects[0].interior = explicitly.objects[0].interior = 0;
  scene.interiors = {dense};
  explicitly.interiors[0] = dense;
  const RenderOptions options = backends().front().options(pixels(48), pixels(36), 2);
  CHECK(render(scene, options).image == render(explicitly, options).image);
  scene.objects[0].interior = 1;
  CHECK_THROWS_AS(render(scene, options), InputError);
}

TEST_CASE("a camera that looks at a point has it in its middle, and pixels as high as wide") {
  const Vec3 from(1, 2, -7), to(3, -1, 4);
  const Camera camera = Camera::look_at(from, to, 40, 16.0 / 9);
  CHECK(camera.location == from);
  const Vec3 ahead = glm::normalize(to - from);
  CHECK(glm::length(glm::cross(camera.direction, ahead)) == Approx(0).margin(1e-12));
  CHECK(glm::dot(camera.direction, ahead) > 0);
  CHECK(glm::dot(camera.direction, camera.right) == Approx(0).margin(1e-12));
  CHECK(glm::dot(camera.direction, camera.up) == Approx(0).margin(1e-12));
  CHECK(glm::dot(camera.right, camera.up) == Approx(0).margin(1e-12));
  CHECK(camera.right.y == Approx(0).margin(1e-12));
  CHECK(camera.up.y > 0);
  CHECK(glm::length(camera.right) / glm::length(camera.up) == Approx(16.0 / 9));
  const double half = std::atan(0.5 * glm::length(camera.right) / glm::length(camera.direction));
  CHECK(half * 2 * 180 / 3.14159265358979 == Approx(40));
  // To the right in the picture is to the right.
  CHECK(Camera::look_at({0, 0, -5}, {0, 0, 0}).right.x > 0);
  // It may be turned.
  CHECK(Camera::look_at({0, 0, -5}, {0, 0, 0}, 60, 1, {1, 0, 0}).up.x > 0);
}

TEST_CASE("a camera that cannot be is refused") {
  const Vec3 from(0, 0, -5), to(0, 0, 0);
  CHECK_THROWS_AS(Camera::look_at(from, from), InputError);
  CHECK_THROWS_AS(Camera::look_at(from, {0, 0, std::numeric_limits<double>::infinity()}), InputError);
  CHECK_THROWS_AS(Camera::look_at({0, 5, 0}, to), InputError);
  CHECK_THROWS_AS(Camera::look_at(from, to, 60, 1, {0, 0, 0}), InputError);
  for (const double angle : {0.0, -1.0, 180.0, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(Camera::look_at(from, to, angle), InputError);
  for (const double aspect : {0.0, -1.0, std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(Camera::look_at(from, to, 60, aspect), InputError);
}
