// Every scene file renders on every backend, to the same picture for any number of SPEs, and to POV-Ray's.
#include "picture_files.hpp"

#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using celltrace::test::pov_ray_picture;
using celltrace::test::scenes_in;

namespace {

RenderResult render_on(const Scene& scene, const std::string& backend, unsigned spes) {
  RenderOptions options;
  options.backend = backend;
  options.spes = spes;
  RenderResult result = render(scene, options);
  REQUIRE(result.complete);
  REQUIRE(result.statistics.backend == backend);
  REQUIRE(result.statistics.spes.size() == spes);
  return result;
}

void check_backends(const Scene& scene, const Image& expected) {
  for (const unsigned spes : {1u, 2u, 6u, 8u, 16u}) {
    INFO(spes << " SPEs");
    const RenderResult native = render_on(scene, "native", spes);
    const RenderResult emulated = render_on(scene, "cell_emu", spes);
    CHECK(compare_images(native.image, expected).psnr >= 60);
    CHECK(compare_images(emulated.image, expected).psnr >= 60);
    CHECK(native.statistics.total_rays() == emulated.statistics.total_rays());
    CHECK(emulated.statistics.dropped_rays == 0);
  }
}

/// Checks all scenes of a folder; returns how many came out at `good` dB or more against POV-Ray's picture.
int check_scenes(const std::vector<std::filesystem::path>& scenes, double least, double good) {
  int as_good = 0;
  for (const auto& path : scenes) {
    INFO(path.filename().string());
    const Scene scene = parse_file(path);
    const Image picture = render_on(scene, "native", 1).image;
    check_backends(scene, picture);
    const auto reference = pov_ray_picture(path);
    if (!reference) {
      WARN(path.filename().string() << ": not compared, as POV-Ray is not installed");
      continue;
    }
    const Comparison comparison = compare_images(picture, *reference);
    INFO(to_text(comparison));
    CHECK(comparison.psnr >= least);
    as_good += comparison.psnr >= good ? 1 : 0;
  }
  return as_good;
}

} // namespace

TEST_CASE("The project's scenes look as POV-Ray's on every backend") {
  const auto scenes = scenes_in(OWN_SCENES);
  REQUIRE(scenes.size() >= 4);
  check_scenes(scenes, 50, 50);
}

TEST_CASE("Published scenes look as POV-Ray's on every backend") {
  const auto scenes = scenes_in(PUBLISHED_SCENES);
  if (scenes.empty()) {
    WARN("skipped: no scenes beside the checkout");
    return;
  }
  REQUIRE(scenes.size() == 10);
  CHECK(check_scenes(scenes, 35, 45) >= 8);
}

TEST_CASE("The cache of a small scene answers nearly every read, and an uneven one is balanced") {
  const Scene scene = parse_file(std::filesystem::path(OWN_SCENES) / "finishes.pov");
  const RenderStatistics s = render_on(scene, "cell_emu", 8).statistics;
  CHECK(s.object_cache.hit_rate() > 0.95);
  CHECK(s.material_cache.hit_rate() > 0.95);
  CHECK(s.list_cache.hit_rate() > 0.95);
  CHECK(s.primary_rays == 640u * 480u);
  CHECK(s.shadow_rays > 0);
  CHECK(s.reflection_rays > 0);
  CHECK(s.balance_exchanges > 0);
}
