// The pictures: the same from every backend with any number of SPEs, and close to those of the reference
// tracer.
#include "celltrace/image.hpp"
#include "reference/tracer.hpp"
#include "render/backends.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;

namespace {

constexpr int kWidth = pixels(160);
constexpr int kHeight = pixels(120);

Image render_on(const Backend& backend, unsigned spes, const Scene& scene) {
  const RenderResult result = render(scene, backend.options(kWidth, kHeight, spes));
  REQUIRE(result.complete);
  REQUIRE(result.statistics.spu == backend.spu());
  REQUIRE(result.statistics.spes.size() == spes);
  REQUIRE(result.statistics.dropped_rays == 0);
  return result.image;
}

} // namespace

TEST_CASE("Pictures come close to the reference tracer's") {
  const Backend backend = backends().front();
  for (const NamedScene& named : scenes()) {
    INFO(named.name);
    const Scene scene = named.make();
    const Image expected = reference::Tracer(scene).render(kWidth, kHeight);
    const Image picture = render_on(backend, 2, scene);
    const Comparison comparison = compare_images(expected, picture);
    INFO(to_text(comparison));
    CHECK(comparison.psnr >= 60);
  }
}

TEST_CASE("Every backend with any number of SPEs renders the same picture") {
  for (const NamedScene& named : scenes()) {
    INFO(named.name);
    const Scene scene = named.make();
    const Image expected = render_on(backends().front(), 1, scene);
    for (const Backend& backend : backends())
      for (unsigned spes : {1u, 2u, 3u, 8u, 16u}) {
        INFO(backend.spu() << " with " << spes);
        CHECK(render_on(backend, spes, scene) == expected);
      }
  }
}
