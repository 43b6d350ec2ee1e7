// Scenes far from the origin, and cameras far from what they see.
#include "celltrace/image.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/ray_queries.hpp"
#include "celltrace/render.hpp"
#include "celltrace/session.hpp"
#include "prepare/scene_origin.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <tuple>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace celltrace;

namespace {

const std::string kHead = "#version 3.7; global_settings { assumed_gamma 1 }\n"
                          "light_source { O + <5, 8, -6>, 1 }\n";
const std::string kCamera = "camera { location O + <0, 1, -6> look_at O angle 45 }\n";

/// A bit of everything, at O.
const std::string kThings =
    "sphere { O, 1 pigment { checker rgb 1, rgb x scale 0.3 translate O } }\n"
    "box { O + <-2, -1, -1>, O + <-1, 0, 1> pigment { rgb y } }\n"
    "mesh2 { vertex_vectors { 3, <1, 0, 0>, <2, 0, 0.2>, <1.5, 1, 0.1> } "
    "face_indices { 1, <0, 1, 2> } translate O pigment { rgb z } }\n"
    "triangle { O + <1, 1, 0>, O + <2, 1, 0>, O + <1.5, 2, 0> pigment { rgb 1 } }\n"
    "difference { cylinder { O + <1, -1, -1>, O + <2, -0.6, 0>, 0.4 } sphere { O + <1.5, -0.8, -1>, 0.4 } "
    "pigment { rgb x + z } }\n"
    "torus { 0.5, 0.1 translate O - y pigment { bozo color_map { [0 rgb x] [1 rgb y] } scale 0.2 translate O "
    "} }\n"
    "plane { y, -1.2 translate O pigment { checker rgb 1, rgb 0.5 } }\n"
    "fog { fog_type 2 distance 20 rgb 0.5 fog_offset O.y - 1 fog_alt 0.3 }\n";

Scene at(const std::string& place, const std::string& text) {
  return parse_string("#declare O = " + place + ";\n" + kHead + text);
}

RenderOptions small(Backend backend = Backend::native) {
  RenderOptions options;
  options.width = 80;
  options.height = 60;
  options.backend = backend;
  options.spes = 2;
  return options;
}

double psnr(const Image& a, const Image& b) {
  return compare_images(a, b).psnr;
}

} // namespace

TEST_CASE("A scene in map coordinates looks as at the origin") {
  const Backend backend = GENERATE(Backend::native, Backend::cell_emu);
  const auto options = small(backend);
  const Image near = render(at("<0, 0, 0>", kCamera + kThings), options).image;
  // Its checkers are not moved: so far away is as many of them.
  const Image far = render(at("<500000, 2000, 5400000>", kCamera + kThings), options).image;
  CHECK(psnr(near, far) > 40);
}

TEST_CASE("Only scenes that are far from the origin have another one") {
  CHECK(origin_for(at("<20, 0, 100>", kThings)) == Vec3(0));
  CHECK(origin_for(at("<0, 0, 0>", kThings)) == Vec3(0));
  CHECK(origin_for(Scene()) == Vec3(0));
  const Vec3 origin = origin_for(at("<500000, 0, 5400000>", kThings));
  CHECK(glm::distance(origin, Vec3(500000, 0, 5400000)) < 4);
  CHECK(origin == glm::round(origin * 4.0) / 4.0);
}

TEST_CASE("Cameras, objects and rays of a scene in map coordinates move as at the origin") {
  const Vec3 place(500000, 0, 5400000);
  auto options = small();
  options.ray_queries = true;
  Session near(at("<0, 0, 0>", kCamera + kThings), options),
      far(at("<500000, 0, 5400000>", kCamera + kThings), options);
  for (Session* const session : {&near, &far})
    session->render();
  const auto check_same = [&] { CHECK(psnr(near.render().image, far.render().image) > 40); };
  Camera camera = near.scene().camera;
  camera.location += Vec3(1, 0.5, 0.5);
  near.set_camera(camera);
  camera.location += place;
  far.set_camera(camera);
  check_same();
  const Transform aside = Transform::translate({0, 0.5, 0});
  near.set_transform(0, aside);
  far.set_transform(0, aside);
  check_same();
  for (Index light = 0; light < near.scene().lights.size(); ++light) {
    Light moved = near.scene().lights[light];
    moved.location.x = -4;
    near.set_light(light, moved);
    moved.location += place;
    far.set_light(light, moved);
  }
  check_same();

  const Ray ray = {{0, 0.5f, -6}, {0, 0, 1}};
  Ray moved = ray;
  for (int axis = 0; axis < 3; ++axis)
    moved.origin[axis] += static_cast<float>(place[axis]);
  RayQueries near_rays = near.ray_queries(), far_rays = far.ray_queries();
  const RayHit hit = near_rays.closest_hit(ray), far_hit = far_rays.closest_hit(moved);
  REQUIRE(hit);
  CHECK(far_hit.object == hit.object);
  CHECK(far_hit.distance == Approx(hit.distance).margin(0.5)); // of the ray's own single precision
  CHECK(far_rays.occluded(moved));
  RayHit hits[2];
  const Ray rays[2] = {moved, moved};
  far_rays.closest_hits(rays, hits);
  CHECK(hits[1].distance == far_hit.distance);
  CHECK(far_rays.surface(moved, far_hit).point[2] == Approx(place.z - 1).margin(1));

  const Vec3 middle = 0.5 * (far.render().statistics.bounds[0] + far.render().statistics.bounds[1]);
  CHECK(glm::distance(middle, place) < 10);
}

TEST_CASE("A camera that is far away sees what one that is near does") {
  const Backend backend = GENERATE(Backend::native, Backend::cell_emu);
  const auto options = small(backend);
  const std::string things =
      "sphere { 0, 1 pigment { checker rgb 1, rgb x scale 0.3 } }\n"
      "torus { 1, 0.2 rotate 70*x pigment { rgb x + y } }\n"
      "merge { box { -0.5, 0.2 } box { -0.2, 0.5 } rotate 20 translate x pigment { rgbt 0.5 } }\n"
      "plane { y, -1 pigment { checker rgb 1, rgb 0.5 } }\n";
  const auto seen = [&](const std::string& camera) {
    return render(at("<0, 0, 0>", "camera { " + camera + " look_at 0 }\n" + things), options).image;
  };
  const Image near = seen("orthographic location <0, 20, -100> right 4*x up 3*y");
  const auto text = [](double number) {
    std::ostringstream out;
    out << std::setprecision(15) << number;
    return out.str();
  };
  CHECK(psnr(seen("orthographic location <0, 2e5, -1e6> right 4*x up 3*y"), near) > 40);
  CHECK(psnr(seen("orthographic location <0, 1e6, -5e6> right 4*x up 3*y"), near) > 40);
  const double angle = 2 * std::atan(2 / 1.0198039e6) * 180 / 3.14159265358979;
  CHECK(psnr(seen("location <0, 2e5, -1e6> right x*4/3 angle " + text(angle)), near) > 35);
  CHECK(psnr(seen("ultra_wide_angle location <0, 2e5, -1e6> right x*4/3 angle " + text(angle)), near) > 35);
}

TEST_CASE("Fog and depth count from a camera that is far away") {
  auto options = small();
  options.first_hits = true;
  const auto seen = [&](const std::string& distance, const std::string& camera) {
    return render(at("<0, 0, 0>",
                     "camera { " + camera + " location -" + distance + "*z right 4*x up 3*y look_at 0 }\n" +
                         "sphere { 0, 1 pigment { rgb 1 } }\nfog { distance " + distance + " rgb 0.5 }\n"),
                  options);
  };
  const RenderResult near = seen("100", "orthographic"), far = seen("1e6", "orthographic");
  CHECK(psnr(near.image, far.image) > 35);
  const std::size_t middle = 30 * 80 + 40;
  CHECK(near.first_hits.depth[middle] == Approx(99).epsilon(1e-3));
  CHECK(far.first_hits.depth[middle] == Approx(1e6 - 1).epsilon(1e-6));
}

TEST_CASE("Patterns repeat exactly where they are asked far from their own origin") {
  const std::string pigment =
      GENERATE(as<std::string>{}, "checker rgb 1, rgb x", "hexagon rgb 1, rgb x, rgb y translate y",
               "bozo color_map { [0 rgb 1] [1 rgb x] }", "granite color_map { [0 rgb 1] [1 rgb x] }",
               "crackle color_map { [0 rgb 1] [1 rgb x] }", "quilted color_map { [0 rgb 1] [1 rgb x] }",
               "checker rgb 1, rgb x warp { turbulence 0.5 }",
               "marble color_map { [0 rgb 1] [1 rgb x] } turbulence 0.4 phase 100",
               "checker rgb 1, rgb x warp { repeat 8*x } warp { black_hole 0.5, 0.2 }");
  INFO(pigment);
  const auto seen = [&](const std::string& place) {
    return render(at(place, kCamera + "sphere { O, 1 pigment { " + pigment + " scale 0.5 } }"), small())
        .image;
  };
  // Whole periods: of noise and cubes; of hexagons; and where marble's wave does not count.
  const std::string far = pigment[0] == 'h'   ? "<600000, 70000, 0>"
                          : pigment[0] == 'm' ? "<0, 409600, 819200>"
                                              : "<409600, 204800, 819200>";
  CHECK(psnr(seen("<0, 0, 0>"), seen(far)) > 40);
}
