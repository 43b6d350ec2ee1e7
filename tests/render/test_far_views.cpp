// Where rays of cameras that are far away start: just before what is in the picture, whatever is beside it.
#include "render/far_camera.hpp"
#include "render/scenes.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace celltrace;
using namespace celltrace::test;

namespace {

constexpr double kPerDegree = std::numbers::pi / 180;
/// How far away the nearer and the farther object are.
constexpr double kNear = 1000, kFarther = 3000;

using Kind = Camera::Kind;

/// Cameras whose pictures are about 3.5 wide and 2 high at kNear.
std::vector<Camera> narrow_cameras() {
  std::vector<Camera> cameras;
  const auto add = [&](Kind kind, double right, double up, double angle, double vertical_angle) {
    Camera camera;
    camera.kind = kind;
    camera.location = {10, 20, 30};
    camera.right = {right, 0, 0};
    camera.up = {0, up, 0};
    camera.angle = angle;
    camera.vertical_angle = vertical_angle;
    cameras.push_back(camera);
  };
  add(Kind::perspective, 0.0035, 0.002, 90, 0);
  add(Kind::orthographic, 3.5, 2, 90, 0);
  add(Kind::spherical, 1, 1, 0.2, 0.12);
  add(Kind::ultra_wide_angle, 3.5, 2, 0.2, 0);
  add(Kind::cylinder_1, 1, 0.002, 0.2, 0);
  add(Kind::cylinder_2, 0.0035, 1, 0.12, 0);
  add(Kind::cylinder_3, 1, 2, 0.2, 0);
  add(Kind::cylinder_4, 3.5, 1, 0.12, 0);
  add(Kind::fisheye, 1, 1, 0.2, 0);
  return cameras;
}

/// Where the ray at (u, v) of such a camera is so far ahead, by what Camera says of the kinds.
Vec3 place(const Camera& c, double u, double v, double ahead) {
  const double wide = c.angle * kPerDegree;
  const auto at = [&](const Vec3& aside, double across, double up) {
    return c.location + aside + Vec3(across, up, 1) * ahead;
  };
  switch (c.kind) {
  case Kind::orthographic:
    return at({c.right.x * u, c.up.y * v, 0}, 0, 0);
  case Kind::spherical:
    return at(Vec3(0), std::tan(wide * u), std::tan(c.vertical_angle * kPerDegree * v) / std::cos(wide * u));
  case Kind::ultra_wide_angle: {
    const double across = wide * u, up = wide * v * c.up.y / c.right.x;
    return at(Vec3(0), std::tan(across) / std::cos(up), std::tan(up) / std::cos(across));
  }
  case Kind::cylinder_1:
    return at(Vec3(0), std::tan(wide * u), c.up.y * v / std::cos(wide * u));
  case Kind::cylinder_2:
    return at(Vec3(0), c.right.x * u / std::cos(wide * v), std::tan(wide * v));
  case Kind::cylinder_3:
    return at({0, c.up.y * v, 0}, std::tan(wide * u), 0);
  case Kind::cylinder_4:
    return at({c.right.x * u, 0, 0}, 0, std::tan(wide * v));
  case Kind::fisheye:
    return at(Vec3(0), std::tan(wide * u), std::tan(wide * v));
  default:
    return at(Vec3(0), c.right.x * u, c.up.y * v);
  }
}

/// A scene of one object, and others behind the camera and far away.
Scene around(const Camera& camera, const Object& object) {
  Scene scene;
  scene.camera = camera;
  scene.materials.push_back(matte({1, 1, 1}));
  scene.interiors.emplace_back();
  scene.objects = {object, sphere_at(camera.location + Vec3(0, 0, kFarther), 0.5, 0, 0),
                   sphere_at(camera.location - Vec3(0, 0, 50), 5, 0, 0)};
  return scene;
}

double start_of(const Scene& scene, double margin = 0) {
  return start_of_rays(scene.camera, margin, SceneImage(scene), nullptr);
}

bool is_before(double start, double distance) {
  return start > 0.97 * distance && start < distance;
}

} // namespace

TEST_CASE("What is in the picture bounds where rays of far cameras start, what is beside it does not") {
  for (const Camera& camera : narrow_cameras()) {
    for (const std::pair<double, double>& at :
         {std::pair(0.0, 0.0), {0.43, 0.0}, {-0.43, 0.0}, {0.0, 0.43}, {0.0, -0.43}, {0.3, 0.3}}) {
      const double u = at.first, v = at.second;
      CAPTURE(static_cast<int>(camera.kind), u, v);
      const auto start = [&](double factor, double ahead = kNear, double margin = 0) {
        return start_of(around(camera, sphere_at(place(camera, factor * u, factor * v, ahead), 0.1, 0, 0)),
                        margin);
      };
      CHECK(is_before(start(1), kNear));
      CHECK(is_before(start(1, 2000), 2000));
      if (u == 0 && v == 0) continue;
      const double outside = u == 0.3 ? 3 : 2;
      CHECK(is_before(start(outside), kFarther));
      // A picture that is twice as wide shows it.
      CHECK(is_before(start(outside, kNear, 1), kNear));
    }
    // Behind the camera there is nothing.
    CHECK(is_before(start_of(around(camera, sphere_at(camera.location - Vec3(0, 0, kNear), 0.1, 0, 0))),
                    kFarther));
    // Where the camera is in something, rays start before they leave it, if they can.
    CHECK(start_of(around(camera, sphere_at(camera.location, 1, 0, 0))) < 1);
    CHECK(is_before(start_of(around(camera, sphere_at(camera.location, kNear, 0, 0))), kNear));
  }
}

TEST_CASE("Rays of cameras that see much start at the camera") {
  const auto at_the_camera = [](Camera camera) {
    return start_of(around(camera, sphere_at(place(camera, 0, 0, kNear), 0.1, 0, 0))) == 0;
  };
  for (const Camera& camera : narrow_cameras()) {
    CAPTURE(static_cast<int>(camera.kind));
    Camera wide = camera;
    wide.angle = 70;
    CHECK(at_the_camera(wide) == (camera.kind != Kind::perspective && camera.kind != Kind::orthographic));
    wide = camera;
    wide.right *= 100;
    wide.up *= 100;
    wide.angle = 50;
    wide.vertical_angle = 70;
    CHECK(at_the_camera(wide));
    for (const Kind kind : {Kind::omnimax, Kind::panoramic}) {
      Camera other = camera;
      other.kind = kind;
      CHECK(at_the_camera(other));
    }
  }
}

TEST_CASE("Surfaces of every kind bound where rays of far cameras start") {
  Camera camera = narrow_cameras()[1];
  camera.location = {0, 0, -kNear};
  const auto start = [&](const decltype(Object::shape)& shape, const Transform& transform) {
    Object object = sphere_at({0, 0, 0}, 1, 0, 0);
    object.shape = shape;
    object.transform = transform;
    return start_of(around(camera, object));
  };
  const Transform nowhere;
  // Into the picture, and along the axes out of it.
  const std::vector<decltype(Object::shape)> shapes = {Sphere{{0, 0, 0}, 0.3},
                                                       Box{{{-0.4, -0.3, -0.2}, {0.1, 0.5, 0.6}}},
                                                       Quadric{{4, 9, 16}, {}, {}, -1},
                                                       Quadric{{4, 9, 16}, {}, {0.2, 0.3, 0.4}, -1},
                                                       Cone{{0, -0.4, 0}, {0, 0.4, 0}, 0.3, 0.3, false},
                                                       Cone{{0, -0.4, 0}, {0, 0.4, 0}, 0.1, 0.3, false},
                                                       Torus{0.3, 0.1},
                                                       Disc{{0, 0, 0}, {0, 0, 1}, 0.4, 0}};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    CAPTURE(i);
    CHECK(is_before(start(shapes[i], nowhere), kNear));
    CHECK(is_before(start(shapes[i], Transform::translate({1.6, 0, 0})), kNear));
    CHECK(is_before(start(shapes[i], Transform::translate({0, -0.9, 500})), kNear + 500));
    CHECK(is_before(
        start(shapes[i], Transform::scale({0.5, 0.5, 0.5}).then(Transform::translate({0, 0.9, 500}))),
        kNear + 500));
    for (const Vec3& aside : {Vec3(4, 0, 0), Vec3(-4, 0, 0), Vec3(0, 3, 0), Vec3(0, -3, 0)}) {
      CAPTURE(aside.x, aside.y);
      CHECK(is_before(start(shapes[i], Transform::translate(aside)), kFarther));
    }
  }
  // What has no bounds: planes across and beside, a cylinder around the view, and two sheets.
  CHECK(is_before(start(Plane{{0, 0, 1}, 7}, nowhere), kNear + 7));
  CHECK(is_before(start(Plane{{0, 1, 0}, -2}, nowhere), kFarther));
  CHECK(is_before(start(Plane{{0, 1, 0}, 0.5}, Transform::rotate({0.01, 0, 0})), kNear) == false);
  CHECK(start(Plane{{0, 1, 0}, -0.5}, nowhere) == 0); // along the view
  CHECK(is_before(start(Quadric{{1, 1, 0}, {}, {}, -9}, nowhere), kFarther));
  CHECK(start(Quadric{{1, 1, 0}, {}, {}, -1}, nowhere) == 0);
  CHECK(is_before(start(Quadric{{1, 1, -1}, {}, {}, 100}, Transform::translate({0, 0, 20})), kNear + 20));
  CHECK(is_before(start(Quadric{{1, 1, 0}, {}, {0, 0, -1}, 0}, nowhere),
                  kNear)); // a paraboloid that opens away
}
