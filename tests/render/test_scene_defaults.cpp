// What of a scene need not be said, or is said in another way: a camera by where it looks, objects without an
// interior.
#include "celltrace/camera_ray.hpp"
#include "celltrace/error.hpp"
#include "render/backends.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

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

TEST_CASE("objects without an interior are told apart") {
  Scene scene = two_balls();
  scene.objects.push_back(scene.objects[0]);
  auto both = std::make_shared<Csg>();
  both->operation = Csg::Operation::union_;
  both->parts = {scene.objects[0], scene.objects[1]};
  scene.objects[2].shape = std::shared_ptr<const Csg>(std::move(both));
  scene.objects[2].transform = Transform::translate({0, 2.1, 0});
  scene.objects[0].interior = scene.add(Interior());
  for (const TestBackend& backend : backends()) {
    INFO(backend.spu());
    RenderOptions options = backend.options(48, 36, 2);
    options.first_hits = true;
    const RenderResult result = render(scene, options);
    const auto& ids = result.first_hits.object;
    const auto id_at = [&](const Vec3& point) {
      // By the ray that is nearest to the point.
      std::size_t best = 0;
      double least = 1e9;
      for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x) {
          const auto ray = camera_ray(scene.camera, 48, 36, x + 0.5, y + 0.5);
          REQUIRE(ray);
          const Vec3 along(ray->direction[0], ray->direction[1], ray->direction[2]);
          const double distance = glm::length(glm::cross(point - scene.camera.location, along));
          if (distance < least) least = distance, best = static_cast<std::size_t>(y * 48 + x);
        }
      return ids[best];
    };
    CHECK(id_at({-2.4, -1.4, 0}) == 0);
    CHECK(id_at({-1.5, 0, 0}) == 1); // its interior's
    CHECK(id_at({1, 0, 0}) == 1 + 1 + 1);
    CHECK(id_at({-1.5, 2.1, 0}) == 1 + 1 + 2);
    CHECK(id_at({1, 2.1, 0}) == 1 + 1 + 2); // a part of the same object
  }
}

TEST_CASE("a camera that looks at a point has pictures of any shape") {
  Scene scene;
  scene.add(Material());
  scene.objects.emplace_back();
  scene.objects[0].shape = Sphere{{0, 0, 0}, 1};
  scene.objects[0].material = 0;
  RenderOptions options;
  options.first_hits = true;
  // How wide and how high the ball is in the picture.
  const auto size_of_ball = [&](int width, int height) {
    options.width = width;
    options.height = height;
    const RenderResult result = render(scene, options);
    int left = width, right = 0, top = height, bottom = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (result.first_hits.object[static_cast<std::size_t>(y * width + x)] != 0) {
          left = std::min(left, x), right = std::max(right, x + 1);
          top = std::min(top, y), bottom = std::max(bottom, y + 1);
        }
    return std::pair(right - left, bottom - top);
  };
  scene.camera = Camera::look_at({0, 0, -5}, {0, 0, 0}, 60);
  const int wide = size_of_ball(120, 90).first;
  CHECK(wide > 30);
  for (const auto& [width, height] : {std::pair(120, 90), std::pair(120, 120), std::pair(120, 60)})
    CHECK(size_of_ball(width, height) == std::pair(wide, wide));
  SECTION("and of one shape if it is said") {
    scene.camera = Camera::look_at({0, 0, -5}, {0, 0, 0}, 60, 4.0 / 3);
    CHECK(size_of_ball(120, 90) == std::pair(wide, wide));
    const auto [w, h] = size_of_ball(120, 120);
    CHECK(w == wide);
    CHECK(h > wide + 8);
  }
  SECTION("or sees all that it saw, and more") {
    scene.camera.framing = Camera::Framing::whole;
    CHECK(size_of_ball(120, 90) == std::pair(wide, wide));
    CHECK(size_of_ball(120, 120) == std::pair(wide, wide));
    CHECK(size_of_ball(240, 90) == std::pair(wide, wide));
  }
}

TEST_CASE("a scene whose camera or maps cannot be is refused") {
  Scene scene = two_balls();
  CHECK_NOTHROW(validate(scene));
  for (Vec3 Camera::*axis : {&Camera::direction, &Camera::right, &Camera::up}) {
    Scene without = scene;
    without.camera.*axis = Vec3(0);
    CHECK_THROWS_AS(validate(without), InputError);
    CHECK_THROWS_AS(validate(without.camera), InputError);
  }
  PatternMap<Pigment> map;
  map.pattern.kind = pattern::Gradient{};
  map.entries = {{0.2, {}}, {0.2, {}}, {0.7, {}}};
  const auto with = [&] {
    scene.materials[0].pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
    return scene;
  };
  CHECK_NOTHROW(validate(with()));
  map.entries[2].position = 0.1;
  CHECK_THROWS_WITH(validate(with()), Catch::Contains("do not ascend"));
  // In lists positions mean nothing.
  map.pattern.kind = pattern::Checker{};
  map.entries.resize(2);
  map.entries[1].position = -1;
  CHECK_NOTHROW(validate(with()));
  scene = two_balls();
  Normal bumps;
  bumps.slopes = {{0.5, 0, 1}, {0.4, 1, 0}};
  scene.materials[0].normal = std::make_shared<const Normal>(bumps);
  CHECK_THROWS_WITH(validate(scene), Catch::Contains("do not ascend"));
  scene = two_balls();
  Rainbow bow;
  bow.colours = {{0.5, {}, 0, 0}, {0.4, {}, 0, 0}};
  scene.rainbows.push_back(bow);
  CHECK_THROWS_WITH(validate(scene), Catch::Contains("do not ascend"));
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
