// What is seen first: depths, normals and objects beside the colours.
#include "render/all_machines.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace celltrace;
using namespace celltrace::test;

namespace {

RenderOptions with_first_hits(const TestBackend& backend, unsigned spes = 2) {
  RenderOptions options = backend.options(75, 45, spes);
  options.first_hits = true;
  return options;
}

/// Seen along z from z = -10, eight units wide; a ball of radius 2 with its middle at the origin.
Scene ball() {
  Scene scene;
  scene.camera = orthographic_camera({0, 0, -10}, {0, 0, 0}, 8);
  scene.add(Interior{});
  scene.objects.push_back(sphere_at({0, 0, 0}, 2, scene.add(glass({1, 1, 1})), scene.add(Interior{})));
  return scene;
}

} // namespace

TEST_CASE("First hits are what geometry says, on every backend") {
  for (const TestBackend& backend : all_machines()) {
    INFO(backend.spu());
    const RenderResult result = render(ball(), with_first_hits(backend));
    const FirstHits& hits = result.first_hits;
    REQUIRE(hits.depth.size() == 75 * 45);
    REQUIRE(hits.normal.size() == 3 * 75 * 45);
    CHECK(result.colours.rgba.empty());
    float worst = 0;
    for (int y = 0; y < 45; ++y)
      for (int x = 0; x < 75; ++x) {
        const auto i = static_cast<std::size_t>(75 * y + x);
        const double px = (x + 0.5 - 37.5) / 75 * 8, py = -(y + 0.5 - 22.5) / 45 * 6;
        const double square = 4 - px * px - py * py;
        if (std::fabs(square) < 1e-3) continue;
        if (square < 0) {
          CHECK(std::isinf(hits.depth[i]));
          CHECK(hits.object[i] == 0);
          CHECK(hits.normal[3 * i] == 0);
          continue;
        }
        const double z = -std::sqrt(square);
        CHECK(hits.object[i] == 2);
        const double expected[4] = {10 + z, px / 2, py / 2, z / 2};
        const float found[4] = {hits.depth[i], hits.normal[3 * i], hits.normal[3 * i + 1],
                                hits.normal[3 * i + 2]};
        for (int k = 0; k < 4; ++k)
          worst = std::max(worst, std::fabs(found[k] - static_cast<float>(expected[k])));
      }
    CHECK(worst < 2e-4f);
  }
}

TEST_CASE("First hits are the same to the bit on native and cell_emu, whatever else is asked for") {
  for (const std::string name : {"glass and mirrors", "meshes", "fog and insides"}) {
    CAPTURE(name);
    const Scene scene = scene_named(name);
    std::optional<FirstHits> first;
    for (const TestBackend& backend : backends())
      for (const bool more : {false, true}) {
        INFO(backend.spu());
        RenderOptions options = with_first_hits(backend, more ? 3 : 1);
        options.alpha = options.colours = more;
        if (more) options.antialiasing.emplace();
        const RenderResult result = render(scene, options);
        if (!first) first = result.first_hits;
        CHECK(result.first_hits.depth == first->depth);
        CHECK(result.first_hits.normal == first->normal);
        CHECK(result.first_hits.object == first->object);
        const RenderOptions plain = [&] {
          RenderOptions without = options;
          without.first_hits = false;
          return without;
        }();
        CHECK(render(scene, plain).image == result.image);
      }
  }
}

TEST_CASE("First hits of a region are those of the whole picture") {
  RenderOptions options = with_first_hits(backends().front());
  const Scene scene = scene_named("glass and mirrors");
  const FirstHits whole = render(scene, options).first_hits;
  options.region = PictureRegion{5, 60, 7, 30};
  const FirstHits part = render(scene, options).first_hits;
  for (int y = 0; y < 45; ++y)
    for (int x = 0; x < 75; ++x) {
      const auto i = static_cast<std::size_t>(75 * y + x);
      const bool inside = x >= 5 && x < 60 && y >= 7 && y < 30;
      REQUIRE(part.object[i] == (inside ? whole.object[i] : 0));
    }
}

TEST_CASE("First hits of rows are those of the whole picture") {
  RenderOptions options = with_first_hits(backends().front());
  options.antialiasing.emplace();
  const Scene scene = scene_named("glass and mirrors");
  const FirstHits whole = render(scene, options).first_hits;
  Renderer renderer(options);
  REQUIRE(renderer.prepare(scene));
  CHECK(renderer.render_rows(0, 32).first_hits.object[75 * 40 + 37] == 0);
  const FirstHits lower = renderer.render_rows(32, 45).first_hits;
  for (std::size_t i = 0; i < whole.object.size(); ++i)
    REQUIRE(lower.object[i] == (i < 32 * 75 ? 0 : whole.object[i]));
}

TEST_CASE("First hits are for one model") {
  RenderOptions options = with_first_hits(backends().front(), 4);
  options.model = Model::pipeline;
  CHECK_THROWS_AS(Renderer(options), InputError);
}
