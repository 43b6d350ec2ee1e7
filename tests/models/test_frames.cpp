// Models other than the shared one from frame to frame: progress, cancelling, reuse, counts, errors.
#include "celltrace/error.hpp"
#include "models/models.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <stdexcept>
#include <vector>

using namespace celltrace;
using namespace celltrace::test;

namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;

RenderOptions small(Model model, Backend backend, unsigned spes) {
  return model_options(model, backend, spes, kWidth, kHeight);
}
Image expected_of(const Scene& scene) {
  return render(scene, small(Model::shared, Backend::native, 1)).image;
}

} // namespace

TEST_CASE("Progress of every model starts at 0, never falls and ends at 1") {
  const Scene scene = scene_named("glass and mirrors");
  for (const NamedModel& model : kModels) {
    for (const Backend backend : {Backend::native, Backend::cell_emu}) {
      INFO(model.name << " on " << name_of(backend));
      std::vector<double> fractions;
      const RenderResult result = render(scene, small(model.model, backend, 5), [&](double fraction) {
        fractions.push_back(fraction);
        return true;
      });
      REQUIRE(result.complete);
      check_completed(fractions);
    }
  }
}

TEST_CASE("A cancelled frame of any model is followed by a whole one") {
  const Scene scene = scene_named("glass and mirrors");
  const Image expected = expected_of(scene);
  for (const NamedModel& model : kModels) {
    for (const Backend backend : {Backend::native, Backend::cell_emu}) {
      for (unsigned spes : {2u, 5u, 16u}) {
        INFO(model.name << " on " << name_of(backend) << " with " << spes);
        Renderer renderer(small(model.model, backend, spes));
        for (const double until : {0.0, 0.1, 0.6}) {
          const RenderResult broken =
              renderer.render(scene, [&](double fraction) { return fraction < until; });
          CHECK(!broken.complete);
          // Whoever cancels at 0 has no scene yet.
          const RenderResult whole = until == 0 ? renderer.render(scene) : renderer.render(scene.camera);
          REQUIRE(whole.complete);
          CHECK(whole.image == expected);
        }
      }
    }
  }
}

TEST_CASE("An exception of progress passes through a model, and the next frame is whole") {
  const Scene scene = scene_named("highlights");
  const Image expected = expected_of(scene);
  for (const NamedModel& model : kModels) {
    INFO(model.name);
    Renderer renderer(small(model.model, Backend::cell_emu, 5));
    CHECK_THROWS_AS(renderer.render(scene, [](double) -> bool { throw std::runtime_error("enough"); }),
                    std::runtime_error);
    CHECK(renderer.render(scene).image == expected);
  }
}

TEST_CASE("A renderer goes from scene to scene and camera to camera under every model") {
  for (const NamedModel& model : kModels) {
    Renderer renderer(small(model.model, Backend::cell_emu, 6));
    for (const char* name : {"meshes", "empty", "glass and mirrors"}) {
      INFO(model.name << ", " << name);
      Scene scene = scene_named(name);
      CHECK(renderer.render(scene).image == expected_of(scene));
      scene.camera.location.x += 0.5;
      CHECK(renderer.render(scene.camera).image == expected_of(scene));
    }
  }
}

TEST_CASE("The split pipeline counts the rays that it sends back") {
  const Scene scene = scene_named("highlights");
  RenderOptions options = small(Model::pipeline_split, Backend::cell_emu, 8);
  const RenderStatistics::Stages split = render(scene, options).statistics.stages;
  options.model = Model::pipeline;
  const RenderStatistics::Stages joined = render(scene, options).statistics.stages;
  CHECK(split.primary_hits == joined.primary_hits);
  CHECK(split.primary_hits > 0);
  CHECK(split.primary_hits < std::uint64_t{kWidth} * kHeight);
  CHECK(split.returns >= split.primary_reprocessed);
  CHECK(split.primary_hits_reprocessed > 0);
  CHECK(split.primary_hits_reprocessed <= split.primary_reprocessed);
  CHECK(split.primary_hits_reprocessed <= split.primary_hits);
  CHECK(split.searches > joined.searches);
  CHECK(joined.returns == 0);
  CHECK(joined.primary_reprocessed == 0);
  CHECK(split.generators + split.shaders + split.searchers + split.testers == 8);
  CHECK(split.testers > 0);
  CHECK(joined.generators + joined.shaders + joined.searchers == 8);
}

TEST_CASE("A pipeline reports what its caches did") {
  const Scene scene = scene_named("glass and mirrors");
  for (const NamedModel& model : kModels) {
    INFO(model.name);
    const RenderStatistics s = render(scene, small(model.model, Backend::cell_emu, 5)).statistics;
    // Rays that lie side by side ask for the same lines.
    for (const RenderStatistics::Cache* cache : {&s.object_cache, &s.material_cache}) {
      CHECK(cache->misses > 0);
      CHECK(cache->hits > cache->misses);
    }
  }
}

TEST_CASE("The shared model has no stages") {
  const RenderStatistics s =
      render(scene_named("empty"), small(Model::shared, Backend::native, 2)).statistics;
  CHECK(s.model == Model::shared);
  CHECK(s.stages.jobs == 0);
  CHECK(s.stages.shaders == 0);
}

TEST_CASE("The PPE of the offload model is one more SPE") {
  const RenderStatistics s =
      render(scene_named("highlights"), small(Model::offload, Backend::cell_emu, 3)).statistics;
  CHECK(s.spes.size() == 4);
  CHECK(s.stages.searchers == 3);
  const RenderStatistics whole_cell =
      render(scene_named("empty"), small(Model::offload, Backend::cell_emu, 0)).statistics;
  CHECK(whole_cell.stages.searchers == 8);
}

TEST_CASE("A large cache leaves fewer packets under way, and the same picture") {
  const Scene scene = scene_named("glass and mirrors");
  const Image expected = expected_of(scene);
  for (const NamedModel& model : kModels) {
    RenderOptions options = small(model.model, Backend::cell_emu, 5);
    options.cache.sets = 128;
    options.cache.ways = 4;
    CHECK(render(scene, options).image == expected);
    options.cache.enabled = false;
    CHECK(render(scene, options).image == expected);
  }
}

TEST_CASE("What a model cannot do is an error") {
  for (const NamedModel& model : kModels) {
    if (model.model == Model::offload) continue; // has its PPE besides
    CHECK_THROWS_AS(Renderer(small(model.model, Backend::native, 1)), InputError);
  }
  RenderOptions options = small(Model::pipeline_split, Backend::native, 4);
  options.accelerator = Accelerator::bvh;
  CHECK_THROWS_AS(Renderer(options), InputError);
}
