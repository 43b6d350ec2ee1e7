// Shapes of many parts on every machine against POV-Ray 3.7's numbers (tests/evidence/shapes.json): each ray is
// that of a picture of one pixel.
#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "all_machines.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"

using namespace celltrace;
using nlohmann::json;

namespace {

Vec3 vector(const json& numbers, std::size_t first) {
  return {numbers[first].get<double>(), numbers[first + 1].get<double>(), numbers[first + 2].get<double>()};
}

/// Shapes that are not supported yet, and patches, which are meshes.
const char* const kLeftOut[] = {"ss_", "hf_", "iso_", "julia_", "param_", "bz_"};

} // namespace

TEST_CASE("Rays hit shapes of many parts where POV-Ray's do, on every machine") {
  std::ifstream file(CELLTRACE_SOURCE_DIR "/tests/evidence/shapes.json");
  const json shapes = json::parse(file);
  for (const test::TestBackend& backend : test::all_machines()) {
    INFO(backend.spu());
    RenderOptions options;
    options.width = options.height = 1;
    options.spes = 1;
    options.backend = backend.backend;
    options.simd = backend.simd;
    options.first_hits = true;
    for (const auto& [name, shape] : shapes.items()) {
      const std::string& of = name;
      if (std::any_of(std::begin(kLeftOut), std::end(kLeftOut),
                      [&](const char* start) { return of.rfind(start, 0) == 0; }) ||
          !shape.contains("rays"))
        continue;
      INFO(name);
      Scene scene = parse_string("#version 3.7; object { " + shape["sdl"].get<std::string>() + " }");
      const std::size_t rays = backend.backend == Backend::cell_sim ? 2 : shape["rays"].size();
      for (std::size_t i = 0; i < rays; ++i) {
        const json &ray = shape["rays"][i], &hit = shape["hit"][i];
        INFO("ray " << i);
        scene.camera.location = vector(ray, 0);
        scene.camera.direction = glm::normalize(vector(ray, 3));
        scene.camera.right = scene.camera.up = Vec3(0);
        const Vec3 other = std::abs(scene.camera.direction.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
        scene.camera.right = 1e-3 * glm::normalize(glm::cross(scene.camera.direction, other));
        scene.camera.up = 1e-3 * glm::normalize(glm::cross(scene.camera.right, scene.camera.direction));
        const FirstHits found = render(scene, options).first_hits;
        if (hit.is_number()) {
          CHECK(!std::isfinite(found.depth[0]));
          continue;
        }
        const double depth = glm::distance(vector(hit, 0), scene.camera.location);
        CHECK(found.depth[0] == Approx(depth).margin(2e-5));
        Vec3 normal = vector(hit, 3);
        if (glm::dot(normal, scene.camera.direction) > 0) normal = -normal;
        const Vec3 seen(found.normal[0], found.normal[1], found.normal[2]);
        CHECK(glm::distance(seen, normal) < 2e-4);
      }
    }
  }
}
