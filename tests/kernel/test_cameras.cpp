// The rays of every kind of camera, in single precision, against the formulas of the reference.
#include "kernel/cameras/primary_rays.hpp"
#include "lanes.hpp"
#include "reference/camera.hpp"
#include "render/camera_setup.hpp"
#include "scene_image/scene_image.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// Its axes are those of POV-Ray's `look_at`, or any three.
Camera any_camera(Random& random, Camera::Kind kind) {
  Camera camera;
  camera.kind = kind;
  camera.location = random.point(10);
  const Vec3 forward = random.direction();
  const Vec3 right = glm::normalize(glm::cross(random.direction(), forward));
  camera.direction = forward * random.uniform(0.3, 3);
  camera.right = right * (random.uniform(0.3, 3) * (random.below(4) == 0 ? -1 : 1));
  camera.up = glm::cross(forward, right) * random.uniform(0.3, 3);
  if (random.below(3) == 0) {
    camera.right += random.point(0.2);
    camera.up += random.point(0.2);
  }
  camera.angle = random.uniform(0, 400);
  camera.vertical_angle = random.uniform(0, 200);
  return camera;
}

std::unique_ptr<FrameBlock> frame_of(const Camera& camera, std::uint32_t width, std::uint32_t height) {
  auto frame = std::make_unique<FrameBlock>();
  frame->width = width;
  frame->height = height;
  set_camera(*frame, camera, {static_cast<double>(width), static_cast<double>(height)}, {},
             SceneImage(Scene()));
  return frame;
}

/// Some packets of the camera's picture. Returns how many lanes have a ray.
unsigned check(const Camera& camera, const FrameBlock& frame, Random& random) {
  unsigned rays = 0;
  DirectSpu spu;
  for (int k = 0; k < 4; ++k) {
    const std::uint32_t column = random.below((frame.width + 3) / 4),
                        row = random.below((frame.height + 3) / 4);
    RayPacket packet;
    const std::uint32_t lanes = make_primary_rays(spu, frame, column, row, packet);
    for_each_lane(lanes_in_picture(frame, column, row), [&](unsigned l) {
      const double x = column * 4 + l % 4 + 0.5, y = row * 4 + l / 4 + 0.5;
      const auto expected = reference::camera_ray(camera, x / frame.width, y / frame.height);
      const auto seen_near = [&](double size) {
        const double mx = (x / frame.width - 0.5) * size + 0.5, my = (y / frame.height - 0.5) * size + 0.5;
        return reference::camera_ray(camera, mx, my).has_value();
      };
      const bool is_ray = (lanes >> l & 1) != 0;
      // At the edge of what it sees, rounding decides.
      if (is_ray != expected.has_value()) REQUIRE(seen_near(0.999) != seen_near(1.001));
      if (!is_ray || !expected) return;
      ++rays;
      REQUIRE(glm::length(at(packet.direction, l) - expected->direction) < 2e-6);
      REQUIRE(glm::length(at(packet.origin, l) - expected->origin) < 4e-6);
      REQUIRE(packet.start_object.lane[l] == kNoOffset);
    });
  }
  return rays;
}

} // namespace

TEST_CASE("The rays of every kind of camera") {
  for (std::uint32_t kind = 0; kind < Cameras::kCount; ++kind) {
    INFO(Cameras::kNames[kind]);
    Random random(120 + kind);
    unsigned rays = 0;
    for (int k = 0; k < times(2000); ++k) {
      const Camera camera = any_camera(random, static_cast<Camera::Kind>(kind));
      const auto frame = frame_of(camera, 1 + random.below(700), 1 + random.below(700));
      rays += check(camera, *frame, random);
    }
    CHECK(rays > unsigned(times(2000)) * 8);
  }
}

TEST_CASE("Rays of cameras that are far away start before the scene") {
  using Kind = Camera::Kind;
  Random random(121);
  Scene scene;
  Object ball;
  ball.shape = Sphere{{3, -2, 1}, 1.5};
  scene.objects = {ball};
  scene.add(Material());
  const SceneImage image(scene);
  for (const Kind kind :
       {Kind::perspective, Kind::orthographic, Kind::spherical, Kind::ultra_wide_angle, Kind::cylinder_1,
        Kind::cylinder_2, Kind::cylinder_3, Kind::cylinder_4, Kind::fisheye}) {
    INFO(Cameras::kNames[static_cast<std::uint32_t>(kind)]);
    for (const double distance : {1e4, 1e6, 5e6}) {
      Camera camera;
      camera.kind = kind;
      camera.direction = random.direction();
      const Vec3 right = glm::normalize(glm::cross(random.direction(), camera.direction));
      const Vec3 up = glm::cross(camera.direction, right);
      camera.location = Vec3(3, -2, 1) - camera.direction * distance;
      const double size = 4, small = size / distance, degrees = small * 57.29577951308232;
      const bool is_parallel = kind == Kind::orthographic;
      camera.right = right * (is_parallel || kind == Kind::cylinder_4 ? size
                              : kind == Kind::fisheye                 ? 1
                                                                      : small);
      camera.up = up * (is_parallel || kind == Kind::cylinder_3 ? size : kind == Kind::fisheye ? 1 : small);
      camera.angle = camera.vertical_angle = degrees;
      camera.direction *= 0.7; // which counts with two kinds only
      if (kind == Kind::perspective) {
        camera.right *= 0.7;
        camera.up *= 0.7;
      }
      FrameBlock frame{};
      frame.width = frame.height = 100;
      set_camera(frame, camera, {100, 100}, {}, image);
      REQUIRE(frame.camera.ahead > 0);
      DirectSpu spu;
      RayPacket packet;
      const std::uint32_t lanes = make_primary_rays(spu, frame, 8, 14, packet);
      const auto way = start_offset<Simd>(frame.camera, packet.direction.load<Simd>());
      FloatLanes ways;
      way.store(ways.lane);
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        const auto expected = reference::camera_ray(camera, (32.5 + l % 4) / 100, (56.5 + l / 4) / 100);
        REQUIRE(((lanes >> l & 1) != 0) == expected.has_value());
        if (!expected) continue;
        const Vec3 come = at(packet.origin, l) - expected->origin;
        CHECK(glm::length(at(packet.origin, l) - Vec3(3, -2, 1)) < 20);
        CHECK(glm::length(glm::cross(come, expected->direction)) < 1e-5);
        CHECK(glm::length(at(packet.direction, l) - expected->direction) < 4e-7);
        CHECK(ways.lane[l] == Approx(glm::length(come)).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("Only a perspective camera is traced as a pinhole") {
  Random random(119);
  for (std::uint32_t kind = 0; kind < Cameras::kCount; ++kind) {
    INFO(Cameras::kNames[kind]);
    Camera camera;
    camera.kind = static_cast<Camera::Kind>(kind);
    const auto frame = frame_of(camera, 640, 480);
    const PinholeBundle<Simd> bundle(*frame, 20, 15);
    CHECK((bundle.packets != 0) == (camera.kind == Camera::Kind::perspective));
  }
}

TEST_CASE("A camera whose axes have no length does not make rays that are no numbers") {
  DirectSpu spu;
  for (std::uint32_t kind = 0; kind < Cameras::kCount; ++kind) {
    Camera camera;
    camera.kind = static_cast<Camera::Kind>(kind);
    camera.right = camera.up = Vec3(0);
    const auto frame = frame_of(camera, 64, 48);
    RayPacket packet;
    make_primary_rays(spu, *frame, 3, 3, packet);
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      INFO(Cameras::kNames[kind] << ", lane " << l);
      CHECK(std::isfinite(glm::length(at(packet.direction, l))));
    }
  }
}
