#include "render/models/stage_plan.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <string>

namespace celltrace {

using namespace kernel;
using namespace kernel::models;

namespace {

/// The SPEs of one pipeline, by program.
struct SpeRoles {
  bool generator = false; ///< true if the generator has an SPE of its own; if false, a shader also generates
  unsigned shaders = 1;
  unsigned walkers = 0, testers = 0;
  unsigned searchers = 0; ///< SPEs that walk and test in one program
};

/// Returns the division of a pipeline's SPEs that is best for most scenes, measured on eight SPEs
/// (docs/programming-models.md). Searches in a BVH are short, and leave more SPEs to the shaders.
SpeRoles roles_of(Model model, AcceleratorKind accelerator, unsigned spes) {
  SpeRoles roles;
  if (model == Model::offload) {
    roles.searchers = spes - 1;
    return roles;
  }
  const bool split = model == Model::pipeline_split;
  roles.generator = spes >= (split ? 4u : 3u);
  const unsigned others = spes - (roles.generator ? 1 : 0);
  const unsigned shaders_of_seven = split ? 1 : accelerator == AcceleratorKind::grid ? 2 : 4;
  roles.shaders = std::max(1u, others * shaders_of_seven / 7);
  const unsigned left = others - roles.shaders;
  if (!split) {
    roles.searchers = left;
  } else if (left >= 2) {
    roles.testers = std::max(1u, left / 3);
    roles.walkers = left - roles.testers;
  } // else one SPE walks and tests in turn
  return roles;
}

/// Plans one pipeline on the `spes` SPEs from `first` on.
void plan_pipeline(Model model, AcceleratorKind accelerator, unsigned first, unsigned spes, unsigned pipeline,
                   StagePlan& plan) {
  const SpeRoles roles = roles_of(model, accelerator, spes);
  unsigned next = first;
  const unsigned generator = next;
  next += roles.generator ? 1 : 0;
  const unsigned first_shader = next;
  const unsigned first_searcher = first_shader + roles.shaders;
  const bool split = model == Model::pipeline_split;
  const unsigned walkers = split ? std::max(roles.walkers, 1u) : roles.searchers;
  const unsigned first_tester = roles.testers != 0 ? first_searcher + walkers : first_searcher;
  const unsigned testers = std::max(roles.testers, 1u);

  StageBlock common{};
  common.generator = generator;
  common.first_searcher = first_searcher;
  common.searchers = walkers;
  for (unsigned context = 0; context < kMaxContexts; ++context) {
    common.searcher[context] = static_cast<std::uint8_t>(first_searcher + context % walkers);
    common.tester[context] = static_cast<std::uint8_t>(first_tester + context % testers);
    common.shader[context] = static_cast<std::uint8_t>(first_shader + context % roles.shaders);
  }
  common.announced = (1u << roles.shaders) - 1;
  common.contexts = bell::contexts;
  common.first_row = pipeline;
  common.row_step = plan.pipelines;

  for (unsigned spe = first; spe < first + spes; ++spe) {
    StagePlan::Spe one{StagePlan::Program::searcher, common, pipeline};
    StageBlock& orders = one.orders;
    if (roles.generator && spe == generator) {
      one.program = StagePlan::Program::generator;
      orders.tasks = task::generate;
    } else if (spe < first_searcher) {
      one.program = StagePlan::Program::shader;
      orders.tasks = task::shade | (roles.generator ? 0 : task::generate);
      if (model == Model::offload) orders.tasks |= task::dispatch;
      orders.contexts = 0;
      for (unsigned context = spe - first_shader; context < kMaxContexts; context += roles.shaders)
        orders.contexts |= 1u << context;
    } else if (!split) {
      orders.tasks = task::search | (model == Model::offload ? task::by_mailbox : 0);
    } else {
      const bool walks = spe < first_searcher + walkers;
      const bool tests = spe >= first_tester;
      orders.tasks = (walks ? task::walk : 0) | (tests ? task::test : 0);
    }
    plan.spes.push_back(one);
  }
}

} // namespace

StagePlan plan_stages(Model model, AcceleratorKind accelerator, unsigned spes) {
  if (spes < 2)
    throw InputError("this programming model splits the work of a ray between SPEs: it needs at least 2");
  constexpr unsigned kPipelineSpes = 8;
  StagePlan plan;
  plan.pipelines = model == Model::offload ? 1 : std::max(1u, spes / kPipelineSpes);
  for (unsigned pipeline = 0, first = 0; pipeline < plan.pipelines; ++pipeline) {
    const unsigned members = (spes - first) / (plan.pipelines - pipeline);
    plan_pipeline(model, accelerator, first, members, pipeline, plan);
    first += members;
  }
  return plan;
}

unsigned machine_spes(const RenderOptions& options) {
  if (options.model != Model::offload) return options.spes;
  const unsigned of_the_model = options.backend != Backend::native ? options.emulation.timing.spes : 0;
  const unsigned spes = options.spes != 0 ? options.spes : of_the_model;
  return spes != 0 ? spes + 1 : 0;
}

} // namespace celltrace
