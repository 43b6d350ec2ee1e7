// Every programming model renders the shared model's picture, bit for bit, on every backend and for any
// number of SPEs, and breaks no rule of the Cell.
#include "celltrace/error.hpp"
#include "celltrace/image.hpp"
#include "celltrace/pov.hpp"
#include "models/models.hpp"
#include "records/light_feature.hpp"
#include "render/scenes.hpp"
#include "scene_image/scene_image.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <vector>

using namespace celltrace;
using namespace celltrace::test;

namespace {

struct Machine {
  const char* name;
  Backend backend;
  Schedule schedule;
};
constexpr Machine kMachines[] = {{"native", Backend::native, Schedule::free},
                                 {"cell_emu, free", Backend::cell_emu, Schedule::free},
                                 {"cell_emu, lockstep", Backend::cell_emu, Schedule::lockstep}};

RenderResult render_by(Model model, const Machine& machine, unsigned spes, const Scene& scene) {
  RenderOptions options = model_options(model, machine.backend, spes, pixels(48), pixels(36));
  options.emulation.schedule = machine.schedule;
  std::string broken;
  options.diagnostic = [&](const Diagnostic& diagnostic) { broken += diagnostic.text + "\n"; };
  RenderResult result = render(scene, options);
  CHECK(broken == "");
  REQUIRE(result.complete);
  REQUIRE(result.statistics.backend == machine.backend);
  REQUIRE(result.statistics.model == model);
  return result;
}

/// Whether its shadow rays go from surface to surface.
bool needs_shared_model(const Scene& scene) {
  return (SceneImage(scene).header().light_features &
          (kernel::light_feature::stepwise | kernel::light_feature::projectors)) != 0;
}

/// Whether other models multiply what shadow rays cross, though not all of it counts.
bool has_near_surfaces(const Scene& scene) {
  return (SceneImage(scene).header().light_features & kernel::light_feature::near_surfaces) != 0;
}

void check_models(const Scene& scene, const std::vector<unsigned>& spe_counts = {2, 3, 5, 8}) {
  if (needs_shared_model(scene)) {
    for (const NamedModel& model : kModels)
      CHECK_THROWS_AS(render_by(model.model, kMachines[0], 5, scene), InputError);
    return;
  }
  const bool are_near = has_near_surfaces(scene);
  // An SPE's: on the host packets have other rays, and some questions are asked for all of a packet's.
  const RenderResult expected = render_by(Model::shared, kMachines[1], 1, scene);
  for (const NamedModel& model : kModels) {
    for (const Machine& machine : kMachines) {
      for (unsigned spes : spe_counts) {
        INFO(model.name << " on " << machine.name << " with " << spes << " SPEs");
        const RenderResult result = render_by(model.model, machine, spes, scene);
        if (are_near)
          CHECK(compare_images(result.image, expected.image).psnr > 40);
        else
          CHECK(result.image == expected.image);
        const RenderStatistics& s = result.statistics;
        CHECK(s.primary_rays == expected.statistics.primary_rays);
        CHECK(s.shadow_rays == expected.statistics.shadow_rays);
        CHECK(s.reflection_rays == expected.statistics.reflection_rays);
        CHECK(s.refraction_rays == expected.statistics.refraction_rays);
        CHECK(s.dropped_rays == expected.statistics.dropped_rays);
      }
    }
  }
}

} // namespace

TEST_CASE("Scenes of all kinds look the same under every model") {
  for (const NamedScene& scene : scenes()) {
    INFO(scene.name);
    check_models(scene.make());
  }
}

TEST_CASE("Scene files look the same under every model") {
  unsigned files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CELLTRACE_SOURCE_DIR "/tests/scenes")) {
    if (entry.path().extension() != ".pov") continue;
    INFO(entry.path().filename().string());
    check_models(parse_file(entry.path()), {3, 8});
    ++files;
  }
  CHECK(files >= 4);
}

TEST_CASE("More lights than a job has bits look the same under every model") {
  Scene scene = scene_named("glass and mirrors");
  for (int i = 0; i < 45; ++i)
    scene.lights.push_back({{8.0 - i * 0.4, 5 + 0.1 * i, -6}, {0.01, 0.02, 0.01 * (i % 3)}, i % 7 == 0});
  check_models(scene);
}

TEST_CASE("Triangles of one plane that overlap look the same under every model") {
  check_models(overlapping_triangles());
}

TEST_CASE("Joined pipeline and offload find objects by the BVH as well") {
  const Scene scene = scene_named("meshes");
  for (const Model model : {Model::pipeline, Model::offload}) {
    RenderOptions options = model_options(Model::shared, Backend::cell_emu, 5, pixels(48), pixels(36));
    options.accelerator = Accelerator::bvh;
    const Image expected = render(scene, options).image;
    options.model = model;
    const RenderResult result = render(scene, options);
    CHECK(result.image == expected);
    CHECK(result.statistics.accelerator == Accelerator::bvh);
    CHECK(result.statistics.bvh_nodes > 0);
  }
}

TEST_CASE("Pipelines take the grid unless told otherwise") {
  const Scene scene = scene_named("highlights");
  const auto accelerator = [&](Model model) {
    RenderOptions options = model_options(model, Backend::native, 4, 16, 12);
    options.accelerator = Accelerator::automatic;
    return render(scene, options).statistics.accelerator;
  };
  CHECK(accelerator(Model::pipeline) == Accelerator::grid);
  CHECK(accelerator(Model::pipeline_split) == Accelerator::grid);
  CHECK(accelerator(Model::offload) == Accelerator::bvh);
}
