// Every scene file renders on every backend, to the same picture for any number of SPEs. Whether it is
// POV-Ray's picture is for tools/compare-with-povray to say, which CTest runs.
#include "picture_files.hpp"

#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace celltrace;
using celltrace::test::scenes_in;

namespace {

RenderResult render_on(const Scene& scene, Backend backend, unsigned spes) {
  RenderOptions options;
  options.width = 320;
  options.height = 240;
  options.backend = backend;
  options.spes = spes;
  RenderResult result = render(scene, options);
  REQUIRE(result.complete);
  REQUIRE(result.statistics.backend == backend);
  REQUIRE(result.statistics.spes.size() == spes);
  return result;
}

bool nearly(std::uint64_t a, std::uint64_t b) {
  return std::max(a, b) - std::min(a, b) <= std::max(a, b) / 1000;
}

void check_backends(const Scene& scene, const Image& expected) {
  const bool has_areas = std::any_of(scene.lights.begin(), scene.lights.end(),
                                     [](const Light& light) { return light.area.has_value(); });
  for (const unsigned spes : {1u, 2u, 6u, 8u, 16u}) {
    INFO(spes << " SPEs");
    const RenderResult native = render_on(scene, Backend::native, spes);
    const RenderResult emulated = render_on(scene, Backend::cell_emu, spes);
    CHECK(compare_images(native.image, expected).psnr >= 60);
    CHECK(compare_images(emulated.image, expected).psnr >= 60);
    const RenderStatistics &on_host = native.statistics, &on_spes = emulated.statistics;
    // Packets have other rays on the host, and whether materials share what goes on is asked for all of them.
    CHECK(nearly(on_host.total_rays() - on_host.shadow_rays, on_spes.total_rays() - on_spes.shadow_rays));
    // Where nothing can be before a light with an area, the host looks at none of its places.
    if (has_areas)
      CHECK(on_host.shadow_rays <= on_spes.shadow_rays);
    else
      CHECK(nearly(on_host.shadow_rays, on_spes.shadow_rays));
    CHECK(emulated.statistics.dropped_rays == 0);
  }
}

void check_scenes(const std::vector<std::filesystem::path>& scenes) {
  for (const auto& path : scenes) {
    INFO(path.filename().string());
    const Scene scene = parse_file(path);
    check_backends(scene, render_on(scene, Backend::native, 1).image);
  }
}

} // namespace

TEST_CASE("The project's scenes look the same on every backend") {
  const auto scenes = scenes_in(OWN_SCENES);
  REQUIRE(scenes.size() >= 4);
  check_scenes(scenes);
}

TEST_CASE("Published scenes look the same on every backend") {
  const auto scenes = scenes_in(PUBLISHED_SCENES);
  if (scenes.empty()) {
    WARN("skipped: no scenes beside the checkout");
    return;
  }
  REQUIRE(scenes.size() == 10);
  check_scenes(scenes);
}

TEST_CASE("The cache of a small scene answers nearly every read, and an uneven one is balanced") {
  const Scene scene = parse_file(std::filesystem::path(OWN_SCENES) / "finishes.pov");
  const RenderStatistics s = render_on(scene, Backend::cell_emu, 8).statistics;
  CHECK(s.object_cache.hit_rate() > 0.95);
  CHECK(s.material_cache.hit_rate() > 0.95);
  CHECK(s.list_cache.hit_rate() > 0.95);
  CHECK(s.primary_rays == 320u * 240u);
  CHECK(s.shadow_rays > 0);
  CHECK(s.reflection_rays > 0);
  CHECK(s.balance_exchanges > 0);
}
