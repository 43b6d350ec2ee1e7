// The stages under many interleavings, late and reordered DMA, slow SPEs and late words: the same picture
// every time, no rule broken, no deadlock.
#include "celltrace/error.hpp"
#include "models/models.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;

namespace {

RenderOptions exploring(Model model, std::uint64_t seed, int width, int height) {
  RenderOptions options =
      model_options(model, Backend::cell_emu, static_cast<unsigned>(2 + seed % 8), width, height);
  options.emulation.schedule = Schedule::lockstep;
  options.emulation.explore = true;
  options.emulation.seed = seed;
  options.emulation.transfers = TransferTime::random;
  options.emulation.faults = Faults::mixed();
  return options;
}

#ifdef CELLTRACE_SLOW_BUILD
constexpr std::uint64_t kSeeds = 24;
#else
constexpr std::uint64_t kSeeds = 120;
#endif

} // namespace

TEST_CASE("Every model renders the same picture under many seeds") {
  constexpr int kWidth = 24, kHeight = 20;
  for (const char* name : {"glass and mirrors", "meshes"}) {
    const Scene scene = scene_named(name);
    const Image expected =
        render(scene, model_options(Model::shared, Backend::native, 1, kWidth, kHeight)).image;
    for (const NamedModel& model : kModels) {
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        INFO(model.name << ", " << name << ", seed " << seed);
        RenderOptions options = exploring(model.model, seed, kWidth, kHeight);
        std::string broken;
        options.diagnostic = [&](const Diagnostic& diagnostic) { broken += diagnostic.text + "\n"; };
        REQUIRE(render(scene, options).image == expected);
        REQUIRE(broken == "");
      }
    }
  }
}

TEST_CASE("Cancelled frames of every model under many seeds leave nothing behind") {
  constexpr int kWidth = 24, kHeight = 20;
  const Scene scene = scene_named("glass and mirrors");
  const Image expected =
      render(scene, model_options(Model::shared, Backend::native, 1, kWidth, kHeight)).image;
  for (const NamedModel& model : kModels) {
    for (std::uint64_t seed = 1; seed <= kSeeds / 4; ++seed) {
      INFO(model.name << ", seed " << seed);
      std::string broken;
      RenderOptions options = exploring(model.model, seed, kWidth, kHeight);
      options.diagnostic = [&](const Diagnostic& diagnostic) { broken += diagnostic.text + "\n"; };
      {
        Renderer renderer(options);
        unsigned calls = 0;
        renderer.render(scene, [&](double) { return ++calls <= seed % 5; });
        REQUIRE(renderer.render(scene).image == expected);
      }
      REQUIRE(broken == "");
    }
  }
}

TEST_CASE("A run of any model in lockstep can be repeated to the cycle") {
  const Scene scene = scene_named("highlights");
  for (const NamedModel& model : kModels) {
    INFO(model.name);
    RenderOptions options = model_options(model.model, Backend::cell_emu, 8, 32, 24);
    options.emulation.schedule = Schedule::lockstep;
    const RenderStatistics first = render(scene, options).statistics;
    const RenderStatistics second = render(scene, options).statistics;
    CHECK(first.render_cycles > 0);
    CHECK(first.render_cycles == second.render_cycles);
    CHECK(first.dma_bytes_read == second.dma_bytes_read);
  }
}
