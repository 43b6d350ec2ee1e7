// A frame of a camera that has moved is the frame that a fresh renderer makes, to the bit.
#include "picture_files.hpp"

#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"
#include "celltrace/session.hpp"
#include "celltrace/transform.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace celltrace;
using celltrace::test::scenes_in;

namespace {

constexpr int kEyes = 12;

/// Goes around what the camera looks at, nearer and farther, higher and lower.
Camera camera_of_eye(const Camera& camera, int eye) {
  const Vec3 forward = glm::normalize(camera.direction);
  const double distance = std::max(glm::length(camera.location), 1.0);
  const Vec3 middle = camera.location + forward * distance;
  const Transform turn = Transform::rotate({eye % 3 * 7.0 - 7, eye * 30.0 + 5, 0});
  Camera moved = camera;
  moved.location = middle + turn.direction(camera.location - middle) * (1 + 0.2 * (eye % 4 - 1));
  moved.direction = turn.direction(camera.direction);
  moved.right = turn.direction(camera.right);
  moved.up = turn.direction(camera.up);
  return moved;
}

RenderOptions options_on(Backend backend) {
  RenderOptions options;
  options.width = backend == Backend::native ? 160 : 48;
  options.height = options.width * 3 / 4;
  options.backend = backend;
  options.spes = 2;
  return options;
}

void check_frame(const RenderResult& frame, const Scene& scene, Backend backend) {
  const RenderResult fresh = render(scene, options_on(backend));
  REQUIRE(frame.complete);
  CHECK(frame.image == fresh.image);
}

void check_moved(const Scene& given, Backend backend) {
  Renderer renderer(options_on(backend));
  Session session(given, options_on(backend));
  renderer.render(given);
  session.render();
  Scene scene = given;
  for (int eye = 0; eye < kEyes; ++eye) {
    INFO("eye " << eye);
    scene.camera = camera_of_eye(given.camera, eye);
    check_frame(renderer.render(scene.camera), scene, backend);
    session.set_camera(scene.camera);
    check_frame(session.render(), scene, backend);
  }
}

} // namespace

TEST_CASE("Moved cameras see what a fresh renderer shows") {
  for (const auto& path : scenes_in(OWN_SCENES)) {
    INFO(path.filename().string());
    const Scene scene = parse_file(path);
    for (const Backend backend : {Backend::native, Backend::cell_emu})
      check_moved(scene, backend);
  }
}
