// Who does what: every context has one of each stage, and every row of packets one pipeline.
#include "celltrace/error.hpp"
#include "models/models.hpp"
#include "render/models/stage_plan.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;
using namespace celltrace::kernel::models;

namespace {

constexpr auto kGrid = kernel::AcceleratorKind::grid;

void check_context(const StagePlan& plan, const StagePlan::Spe& planned, unsigned context, Model model) {
  const StageBlock& orders = planned.orders;
  const auto tasks = [&](unsigned spe) { return plan.spes.at(spe).orders.tasks; };
  const auto same_pipeline = [&](unsigned spe) { return plan.spes.at(spe).pipeline == planned.pipeline; };
  CHECK((plan.spes.at(orders.shader[context]).orders.contexts >> context & 1) == 1);
  CHECK((tasks(orders.shader[context]) & task::shade) != 0);
  CHECK(same_pipeline(orders.shader[context]));
  CHECK((tasks(orders.generator) & task::generate) != 0);
  CHECK(same_pipeline(orders.generator));
  CHECK(same_pipeline(orders.searcher[context]));
  if (model == Model::pipeline_split) {
    CHECK((tasks(orders.searcher[context]) & task::walk) != 0);
    CHECK((tasks(orders.tester[context]) & task::test) != 0);
    CHECK(same_pipeline(orders.tester[context]));
  } else {
    CHECK((tasks(orders.searcher[context]) & task::search) != 0);
  }
}

} // namespace

TEST_CASE("Every context of a plan has a shader, a generator and searchers of its pipeline") {
  for (const NamedModel& model : kModels) {
    for (unsigned i = 2 * 2; i <= 2 * 40; ++i) {
      const unsigned spes = i / 2;
      const auto accelerator = static_cast<kernel::AcceleratorKind>(i % 2);
      INFO(model.name << " on " << spes);
      const StagePlan plan = plan_stages(model.model, accelerator, spes);
      REQUIRE(plan.spes.size() == spes);
      for (const StagePlan::Spe& planned : plan.spes) {
        CHECK(planned.orders.tasks != 0);
        CHECK(planned.pipeline < plan.pipelines);
        CHECK(planned.orders.first_row == planned.pipeline);
        CHECK(planned.orders.row_step == plan.pipelines);
        for (unsigned context = 0; context < kMaxContexts; ++context)
          check_context(plan, planned, context, model.model);
      }
    }
  }
}

TEST_CASE("A pipeline of a Cell has each stage on SPEs of its own") {
  for (const Model model : {Model::pipeline, Model::pipeline_split}) {
    const StagePlan plan = plan_stages(model, kGrid, 8);
    CHECK(plan.pipelines == 1);
    unsigned generators = 0, shaders = 0;
    for (const StagePlan::Spe& planned : plan.spes) {
      const std::uint32_t tasks = planned.orders.tasks;
      CHECK((tasks & (tasks - 1)) == 0); // one task each
      generators += tasks == task::generate ? 1 : 0;
      shaders += tasks == task::shade ? 1 : 0;
    }
    CHECK(generators == 1);
    CHECK(shaders >= 1);
  }
}

TEST_CASE("Twice the SPEs are two pipelines") {
  CHECK(plan_stages(Model::pipeline, kGrid, 15).pipelines == 1);
  CHECK(plan_stages(Model::pipeline, kGrid, 16).pipelines == 2);
  CHECK(plan_stages(Model::pipeline_split, kGrid, 256).pipelines == 32);
  CHECK(plan_stages(Model::offload, kGrid, 256).pipelines == 1);
}

TEST_CASE("A ray cannot be split on one SPE") {
  CHECK_THROWS_AS(plan_stages(Model::pipeline, kGrid, 1), InputError);
}
