// Ray queries beside each other, and beside pictures.
#include "celltrace/camera_ray.hpp"
#include "celltrace/error.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/ray_queries.hpp"
#include "celltrace/render.hpp"
#include "celltrace/session.hpp"

#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace celltrace;
using Catch::Matchers::Contains;

namespace {

/// A sphere, a box, a floor, a union, which is two objects, a difference, and a mesh of 2,000 triangles that
/// lies in leaves with others.
Scene mixed_scene() {
  return parse_string(
      "camera { location <0, 3, -9> look_at 0 }\n"
      "light_source { <5, 9, -9>, 1 }\n"
      "sphere { <-2, 0, 0>, 1 pigment { rgb 1 } }\n"
      "box { <1, -1, -1>, <2.5, 1, 1> pigment { rgb 1 } rotate 20*y }\n"
      "plane { y, -1 pigment { rgb 1 } }\n"
      "union { sphere { <0, 1, 2>, 0.7 } torus { 1, 0.2 translate <0, 1, 3> } pigment { rgb 1 } }\n"
      "difference { sphere { <0, 0, 0>, 1 } box { -0.6, 0.6 translate <0, 0.5, -0.5> } pigment { rgbt 0.5 } "
      "}\n"
      "mesh {\n"
      "#local R = seed(5);\n"
      "#for (I, 1, 2000)\n"
      "  #local P = <rand(R), rand(R), rand(R)> * 8 - 4;\n"
      "  triangle { P, P + <rand(R), rand(R), rand(R)> - 0.5, P + <rand(R), rand(R), rand(R)> - 0.5 }\n"
      "#end\n"
      "pigment { rgb 1 } }\n");
}

RenderOptions query_options() {
  RenderOptions options;
  options.width = options.height = 16;
  options.ray_queries = true;
  return options;
}

std::vector<Ray> random_rays(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(-6, 6), unit(-1, 1);
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = coordinate(random);
      ray.direction[axis] = unit(random) * 3;
    }
    if (random() % 4 == 0) ray.tfar = std::abs(coordinate(random));
    if (random() % 16 == 0) ray.direction[random() % 3] = 0;
  }
  return rays;
}

/// From one point: coherent ones.
std::vector<Ray> camera_rays(int edge) {
  std::vector<Ray> rays;
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x)
      rays.push_back({{0, 3, -9},
                      {static_cast<float>(x) / static_cast<float>(edge) - 0.5f,
                       static_cast<float>(y) / static_cast<float>(edge) - 0.8f, 1}});
  return rays;
}

bool same(const RayHit& a, const RayHit& b) {
  return a.object == b.object && a.record == b.record &&
         (!a || (a.distance == b.distance && a.u == b.u && a.v == b.v));
}

} // namespace

TEST_CASE("rays of every kind of camera hit what its picture shows") {
  Scene scene = mixed_scene();
  for (int kind = 0; kind <= static_cast<int>(Camera::Kind::fisheye); ++kind) {
    CAPTURE(kind);
    scene.camera.kind = static_cast<Camera::Kind>(kind);
    scene.camera.angle = 100;
    RenderOptions options = query_options();
    options.width = 37;
    options.height = 22;
    options.first_hits = true;
    Renderer renderer(options);
    const FirstHits seen = renderer.render(scene).first_hits;
    RayQueries queries = renderer.ray_queries();
    unsigned hits = 0, others = 0;
    for (int y = 0; y < options.height; ++y)
      for (int x = 0; x < options.width; ++x) {
        const float depth = seen.depth[static_cast<std::size_t>(y) * 37 + static_cast<std::size_t>(x)];
        const auto ray = camera_ray(scene.camera, options.width, options.height, x + 0.5, y + 0.5);
        const RayHit hit = ray ? queries.closest_hit(*ray) : RayHit();
        hits += hit ? 1 : 0;
        if (hit.distance != depth && !(std::abs(hit.distance - depth) < 1e-4f * depth)) ++others;
      }
    CHECK(hits > 200);
    CHECK(others == 0);
  }
  CHECK_THROWS_AS(camera_ray(scene.camera, 0, 5, 0, 0), InputError);
}

TEST_CASE("single rays, packets and streams hit the same") {
  Renderer renderer(query_options());
  renderer.render(mixed_scene());
  RayQueries queries = renderer.ray_queries();
  std::vector<Ray> rays = random_rays(3001, 1);
  const std::vector<Ray> coherent = camera_rays(50);
  rays.insert(rays.end(), coherent.begin(), coherent.end());
  std::vector<RayHit> hits(rays.size()), sixteen(16);
  queries.closest_hits(rays, hits);
  std::vector<std::uint8_t> occluded(rays.size());
  queries.occluded(rays, occluded);
  std::size_t different = 0, hit = 0, objects[7] = {};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayHit single = queries.closest_hit(rays[i]);
    different += same(single, hits[i]) ? 0 : 1;
    different += (occluded[i] != 0) == static_cast<bool>(hits[i]) ? 0 : 1;
    different += queries.occluded(rays[i]) == static_cast<bool>(hits[i]) ? 0 : 1;
    if (!single) continue;
    ++hit;
    REQUIRE(single.object < 7);
    ++objects[single.object];
    CHECK(single.distance < rays[i].tfar);
  }
  CHECK(different == 0);
  CHECK(hit > 1000);
  for (const std::size_t count : objects)
    CHECK(count >= 5);
  for (std::size_t first = 0; first + 16 <= rays.size(); first += 16) {
    queries.closest_hits(std::span(rays).subspan(first, 16), sixteen);
    for (std::size_t i = 0; i < 16; ++i)
      different += same(sixteen[i], hits[first + i]) ? 0 : 1;
  }
  CHECK(different == 0);
}

TEST_CASE("streams that miss, or mostly miss, hit what single rays hit") {
  Renderer renderer(query_options());
  renderer.render(parse_string("light_source { <5, 9, -9>, 1 }\n"
                               "sphere { <0, 0, -1>, 0.3 pigment { rgb 1 } }\n"
                               "box { <0.5, -1, -1>, <1, -0.7, 1> pigment { rgb 1 } }\n"));
  RayQueries queries = renderer.ray_queries();
  // Whole bundles, the last of them not full, of all lengths that rays may have; some turn away from the
  // others.
  for (const int edge : {17, 50, 200}) {
    CAPTURE(edge);
    std::vector<Ray> rays = camera_rays(edge);
    for (std::size_t i = 0; i < rays.size(); ++i)
      for (float& component : rays[i].direction)
        component *= std::pow(10.0f, static_cast<float>(i % 36) - 18) * (i % 997 == 996 ? -1.0f : 1.0f);
    std::vector<RayHit> hits(rays.size());
    queries.closest_hits(rays, hits);
    std::size_t different = 0, hit = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      different += same(queries.closest_hit(rays[i]), hits[i]) ? 0 : 1;
      hit += hits[i] ? 1 : 0;
    }
    CHECK(different == 0);
    CHECK(hit * 200 > rays.size());
    CHECK(hit * 2 < rays.size());
  }
}

// What is subtracted from far origins, or along an axis where a ray hardly moves, is rounded by more than the
// flat boxes of such triangles are wide.
TEST_CASE("rays along axes and from far away hit flat triangles, one by one as in packets") {
  Renderer renderer(query_options());
  renderer.render(parse_string("light_source { <5, 9, -9>, 1 }\n"
                               "mesh {\n"
                               "#for (X, -8, 7) #for (Y, -8, 7)\n"
                               "  triangle { <X, Y, 3>, <X + 1, Y, 3>, <X, Y + 1, 3> }\n"
                               "  triangle { <X, 0.1, Y>, <X, 0.1, Y + 1>, <X + 1, 0.1, Y> }\n"
                               "#end #end\n"
                               "pigment { rgb 1 } }\n"));
  RayQueries queries = renderer.ray_queries();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> coordinate(-8, 8);
  std::vector<Ray> rays(4096);
  for (Ray& ray : rays) {
    const std::size_t along = random() % 3;
    const float away = std::pow(10.0f, static_cast<float>(random() % 7));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = random() % 4 == 0 ? std::floor(coordinate(random)) : coordinate(random);
      ray.direction[axis] = random() % 4 == 0 ? 1e-9f : 0.0f;
    }
    ray.origin[along] = -away;
    ray.direction[along] = 1;
  }
  std::vector<RayHit> hits(rays.size());
  queries.closest_hits(rays, hits);
  std::size_t different = 0, hit = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    // Where triangles meet either may be hit.
    const RayHit single = queries.closest_hit(rays[i]);
    different += single.distance == hits[i].distance && single.object == hits[i].object ? 0 : 1;
    hit += hits[i] ? 1 : 0;
  }
  CHECK(different == 0);
  CHECK(hit > 1000);
}

TEST_CASE("hits have their object, place and normal") {
  Scene scene = mixed_scene();
  scene.objects.pop_back(); // the mesh
  Renderer renderer(query_options());
  renderer.render(scene);
  RayQueries queries = renderer.ray_queries();
  const Ray to_sphere = {{-2, 0, -9}, {0, 0, 5}};
  const RayHit sphere = queries.closest_hit(to_sphere);
  REQUIRE(sphere);
  CHECK(sphere.object == 0);
  CHECK(sphere.distance == Approx(8));
  const RaySurface surface = queries.surface(to_sphere, sphere);
  CHECK(surface.point[2] == Approx(-1));
  CHECK(surface.normal[2] == Approx(-1));
  const RayHit floor = queries.closest_hit({{9, 4, 9}, {0, -2, 0}});
  CHECK(floor.object == 2);
  CHECK(floor.distance == Approx(5));
  CHECK(queries.closest_hit({{0, 1, 9}, {0, 0, -1}}).object == 4);
  CHECK_FALSE(queries.closest_hit({{9, 4, 9}, {0, 1, 0}}));
  CHECK_FALSE(queries.closest_hit({{-2, 0, -9}, {0, 0, 1}, 7.9f}));
  CHECK_FALSE(queries.occluded({{-2, 0, -9}, {0, 0, 1}, 7.9f}));
  CHECK(queries.occluded({{-2, 0, -9}, {0, 0, 1}, 8.1f}));
  CHECK_THROWS_AS(queries.surface(to_sphere, RayHit()), InputError);
  RayHit foreign = sphere;
  foreign.record += 1;
  foreign.object = 5;
  CHECK_THROWS_AS(queries.surface(to_sphere, foreign), InputError);
}

TEST_CASE("instances of a mesh are told apart") {
  auto mesh = std::make_shared<Mesh>();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const Vec3f at(unit(random), unit(random), unit(random));
    for (int corner = 0; corner < 3; ++corner)
      mesh->vertices.push_back(at + 0.1f * Vec3f(unit(random), unit(random), unit(random)));
    mesh->triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}});
  }
  Scene scene;
  scene.add(Material());
  scene.add(Interior());
  for (int i = 0; i < 20; ++i) {
    Object object;
    object.shape = std::shared_ptr<const Mesh>(mesh);
    object.transform = Transform::translate(Vec3(5 * i, 0, 0));
    scene.objects.push_back(object);
  }
  Renderer renderer(query_options());
  renderer.render(scene);
  RayQueries queries = renderer.ray_queries();
  for (std::uint32_t i = 0; i < 20; ++i) {
    const RayHit hit = queries.closest_hit({{5.0f * static_cast<float>(i), 0, -9}, {0, 0, 1}});
    REQUIRE(hit);
    CHECK(hit.object == i);
  }
}

TEST_CASE("queries are of the scene as it was, on every backend") {
  const Backend backend = GENERATE(Backend::native, Backend::cell_emu);
  RenderOptions options = query_options();
  options.backend = backend;
  Session session(mixed_scene(), options);
  CHECK_THROWS_AS(session.ray_queries(), InputError);
  session.render();
  RayQueries before = session.ray_queries();
  const Ray ray = {{-2, 9, -0.5f}, {0, -1, 0}};
  const RayHit hit = before.closest_hit(ray);
  REQUIRE(hit);
  session.set_transform(hit.object, Transform::translate({0, -100, 0}));
  CHECK(same(before.closest_hit(ray), hit)); // not rendered yet
  session.render();
  CHECK_THROWS_AS(before.closest_hit(ray), InputError);
  RayQueries after = session.ray_queries();
  CHECK_FALSE(same(after.closest_hit(ray), hit));
  RayQueries copy = after;
  CHECK(same(copy.closest_hit(ray), after.closest_hit(ray)));
}

TEST_CASE("queries end with the renderer that they are of") {
  const Ray ray = {{-2, 9, -0.5f}, {0, -1, 0}};
  auto renderer = std::make_unique<Renderer>(query_options());
  renderer->render(mixed_scene());
  RayQueries queries = renderer->ray_queries();
  CHECK(queries.closest_hit(ray));
  renderer.reset();
  CHECK_THROWS_AS(queries.closest_hit(ray), InputError);
}

TEST_CASE("each thread asks a copy of its own, also while a frame is rendered") {
  Renderer renderer(query_options());
  const Scene scene = mixed_scene();
  renderer.render(scene);
  RayQueries queries = renderer.ray_queries();
  const std::vector<Ray> rays = random_rays(500, 2);
  std::vector<RayHit> expected(rays.size());
  queries.closest_hits(rays, expected);
  std::vector<std::size_t> different(4);
  std::vector<std::thread> threads;
  for (std::size_t& count : different)
    threads.emplace_back([&count, &rays, &expected, mine = queries]() mutable {
      for (std::size_t i = 0; i < rays.size(); ++i)
        count += same(mine.closest_hit(rays[i]), expected[i]) ? 0 : 1;
    });
  renderer.render(scene.camera);
  for (std::thread& thread : threads)
    thread.join();
  CHECK(different == std::vector<std::size_t>(4));
}

TEST_CASE("ray queries say what they miss") {
  RenderOptions options = query_options();
  options.ray_queries = false;
  Renderer without(options);
  without.render(mixed_scene());
  CHECK_THROWS_WITH(without.ray_queries(), Contains("RenderOptions::ray_queries"));
  options = query_options();
  Renderer empty(options);
  CHECK_THROWS_WITH(empty.ray_queries(), Contains("none is prepared"));
  options.accelerator = Accelerator::grid;
  Renderer grid(options);
  grid.render(mixed_scene());
  CHECK_THROWS_WITH(grid.ray_queries(), Contains("grid"));
  empty.render(mixed_scene());
  RayQueries queries = empty.ray_queries();
  std::vector<RayHit> hits(3);
  CHECK_THROWS_AS(queries.closest_hits(random_rays(2, 1), hits), InputError);
  queries.closest_hits({}, {});
}
