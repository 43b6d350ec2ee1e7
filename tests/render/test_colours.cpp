// Colours as numbers: they are those of the picture, however it is rendered.
#include "celltrace/image.hpp"
#include "render/all_machines.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace celltrace;
using namespace celltrace::test;

namespace {

// Packets, bundles and blocks that are not all whole.
constexpr int kWidth = 75;
constexpr int kHeight = 45;

RenderOptions with_colours(const TestBackend& backend, unsigned spes) {
  RenderOptions options = backend.options(kWidth, kHeight, spes);
  options.colours = true;
  return options;
}

Antialiasing method(Antialiasing::Method which) {
  Antialiasing antialiasing;
  antialiasing.method = which;
  antialiasing.threshold = 0.1;
  return antialiasing;
}

/// Rounding to 16 bits and from there to 8 may end one beside rounding to 8 at once.
void check_agree(const RenderResult& result) {
  REQUIRE(result.colours.width == result.image.width);
  REQUIRE(result.colours.height == result.image.height);
  const DeepImage deep = to_deep_image(result.colours);
  REQUIRE(deep.rgba.size() == result.image.rgba.size());
  int greatest = 0;
  for (std::size_t i = 0; i < deep.rgba.size(); ++i)
    greatest = std::max(greatest, std::abs(static_cast<int>(std::lround(deep.rgba[i] / 257.0)) -
                                           static_cast<int>(result.image.rgba[i])));
  CHECK(greatest <= 1);
}

} // namespace

TEST_CASE("Colours are those of the picture on every backend, antialiased or not") {
  const Scene scene = scene_named("glass and mirrors");
  for (const TestBackend& backend : all_machines())
    for (const unsigned spes : {1u, 3u}) {
      if (spes == 1 && backend.backend == Backend::cell_sim) continue; // takes as long again
      INFO(backend.spu() << " with " << spes);
      RenderOptions options = with_colours(backend, spes);
      check_agree(render(scene, options));
      for (const auto which : {Antialiasing::Method::fixed, Antialiasing::Method::adaptive}) {
        options.antialiasing = method(which);
        check_agree(render(scene, options));
      }
      options.region = PictureRegion{5, 60, 7, 30};
      check_agree(render(scene, options));
    }
}

TEST_CASE("Colours say how they become linear") {
  Scene scene = scene_named("glass and mirrors");
  scene.gamma_mode = GammaMode::assumed;
  scene.assumed_gamma = 1.8;
  const RenderOptions options = with_colours(backends().front(), 1);
  const RenderResult assumed = render(scene, options);
  CHECK(assumed.colours.gamma == std::optional<double>(static_cast<double>(1.8f)));
  check_agree(assumed);
  scene.gamma_mode = GammaMode::srgb;
  const RenderResult encoded = render(scene, options);
  CHECK_FALSE(encoded.colours.gamma);
  check_agree(encoded);
}

TEST_CASE("Colours may be above 1") {
  Scene scene = scene_named("glass and mirrors");
  scene.background = Vec3(7, 0.25, 0);
  scene.objects.clear();
  const RenderResult result = render(scene, with_colours(backends().front(), 1));
  const float* const pixel = result.colours.pixel(kWidth - 1, kHeight - 1);
  CHECK(std::vector<float>(pixel, pixel + 4) == std::vector<float>{7, 0.25f, 0, 1});
}

TEST_CASE("Colours of a frame that was broken off are there where its pixels are") {
  const Scene scene = scene_named("glass and mirrors");
  Renderer renderer(with_colours(backends().front(), 1));
  const RenderResult part = renderer.render(scene, [](double fraction) { return fraction < 0.4; });
  CHECK_FALSE(part.complete);
  check_agree(part);
  check_agree(renderer.render(scene.camera));
}

TEST_CASE("Colours are for one model, and pictures without them have none") {
  RenderOptions options = with_colours(backends().front(), 4);
  options.model = Model::pipeline;
  CHECK_THROWS_AS(Renderer(options), InputError);
  options = backends().front().options(8, 8, 1);
  CHECK(render(scene_named("glass and mirrors"), options).colours.rgba.empty());
}
