#include "render/models/stage_team.hpp"

#include "kernel/models/search_record.hpp"
#include "kernel/shading/ray_stack.hpp"
#include "render/models/stage_programs.hpp"

#include <algorithm>
#include <numeric>
#include <string>

namespace celltrace {

using namespace kernel;
using namespace kernel::models;

namespace {

SpeProgram program_of(StagePlan::Program program) {
  switch (program) {
  case StagePlan::Program::generator:
    return stage_generator_program();
  case StagePlan::Program::searcher:
    return stage_searcher_program();
  case StagePlan::Program::shader:
    break;
  }
  return stage_shader_program();
}

} // namespace

StageTeam::StageTeam(Machine& machine, SharedRecords<FrameBlock>& frame, Model model)
    : machine_(machine), frame_(frame),
      plan_(plan_stages(model, static_cast<AcceleratorKind>(frame[0].accelerator), machine.spe_count())),
      orders_(plan_.spes.size(), machine.byte_order()), reports_(plan_.spes.size(), machine.byte_order()),
      pipelines_(plan_.pipelines) {
  for (unsigned spe = 0; spe < plan_.spes.size(); ++spe)
    if ((plan_.spes[spe].orders.tasks & task::generate) != 0) pipelines_[plan_.spes[spe].pipeline].head = spe;
}

bool StageTeam::render_frame(const Progress& progress) {
  HeldProgress held(progress);
  reports_.clear();
  if (failed_) throw SpeError("an SPE has failed in a frame before");
  const bool complete = held.report(0) && render_frame_while(held);
  if (complete) held.report(1);
  held.rethrow();
  return complete;
}

bool StageTeam::render_frame_while(HeldProgress& held) {
  failed_ = true; // reset if the frame ends normally
  prepare();
  start();
  bool go_on = true;
  const double packets = static_cast<double>(frame_[0].packet_columns) * frame_[0].packet_rows;
  while (!finished()) {
    receive();
    if (!go_on) continue;
    const std::uint64_t complete =
        std::accumulate(pipelines_.begin(), pipelines_.end(), std::uint64_t{0},
                        [](std::uint64_t sum, const Pipeline& p) { return sum + p.packets; });
    // Reports less than 1, which is for the finished frame.
    go_on = held.report(std::min(static_cast<double>(complete) / packets, 0.999));
    if (!go_on) stop();
  }
  leave();
  failed_ = false;
  return go_on;
}

void StageTeam::prepare() {
  const std::size_t searches = std::max(frame_[0].light_places, 1u);
  const std::size_t job_bytes = sizeof(JobRecord) + searches * sizeof(SearchRecord);
  // A context keeps fewer nodes of its stack in local store than the tracer does.
  const std::uint32_t stack_nodes = frame_[0].ray_stack_nodes + kResidentNodes;
  const std::size_t contexts = std::size_t{plan_.pipelines} * kMaxContexts;
  jobs_ = AlignedBlock(contexts * job_bytes);
  ray_stacks_ = AlignedBlock::uninitialised(contexts * stack_nodes * kRayNodeBytes);
  for (unsigned spe = 0; spe < plan_.spes.size(); ++spe) {
    const StagePlan::Spe& planned = plan_.spes[spe];
    StageBlock& orders = orders_[spe];
    orders = planned.orders;
    const std::size_t first = std::size_t{planned.pipeline} * kMaxContexts;
    orders.frame = frame_.ea();
    orders.jobs = to_ea(jobs_.data() + first * job_bytes);
    orders.report = reports_.ea(spe);
    orders.ray_stack = to_ea(ray_stacks_.data() + first * stack_nodes * kRayNodeBytes);
    orders.job_bytes = static_cast<std::uint32_t>(job_bytes);
    orders.stack_nodes = stack_nodes;
  }
  frame_.publish();
  orders_.publish();
}

void StageTeam::start() {
  for (Pipeline& pipeline : pipelines_)
    pipeline = {pipeline.head, 0, false};
  for (unsigned spe = 0; spe < plan_.spes.size(); ++spe)
    machine_.start(spe, program_of(plan_.spes[spe].program), orders_.ea(spe));
}

bool StageTeam::receive() {
  bool any = false;
  for (Pipeline& pipeline : pipelines_) {
    const auto word = machine_.read_out_mailbox(pipeline.head);
    if (!word) continue;
    any = true;
    pipeline.packets = report_count(*word);
    pipeline.finished |= report_kind(*word) == ReportKind::finished;
  }
  if (any) return true;
  throw_if_stopped();
  machine_.wait_for_mail(kCancellablePollInterval);
  return false;
}

bool StageTeam::finished() const {
  return std::all_of(pipelines_.begin(), pipelines_.end(), [](const Pipeline& p) { return p.finished; });
}

void StageTeam::stop() {
  for (unsigned spe = 0; spe < plan_.spes.size(); ++spe) {
    const StagePlan::Spe& planned = plan_.spes[spe];
    if ((planned.orders.tasks & (task::generate | task::shade)) != 0 &&
        !pipelines_[planned.pipeline].finished)
      machine_.write_signal(spe, Signal::two, bell::stop);
  }
}

/// Ends the programs; no job may be in progress anywhere.
void StageTeam::leave() {
  for (unsigned spe = 0; spe < plan_.spes.size(); ++spe) {
    if ((plan_.spes[spe].orders.tasks & task::by_mailbox) != 0)
      machine_.write_in_mailbox(spe, bell::quit);
    else
      machine_.write_signal(spe, Signal::two, bell::quit);
  }
  for (unsigned spe = 0; spe < plan_.spes.size(); ++spe)
    machine_.wait(spe);
  reports_.fetch();
}

RenderStatistics::Stages StageTeam::counts() const {
  RenderStatistics::Stages sum;
  for (unsigned spe = 0; spe < plan_.spes.size(); ++spe) {
    const StageReport& report = reports_[spe];
    const StageBlock& orders = plan_.spes[spe].orders;
    if (plan_.spes[spe].program == StagePlan::Program::searcher) sum.jobs += report.jobs;
    sum.searches += report.searches;
    sum.primary_hits += report.primary_hits;
    sum.primary_reprocessed += report.primary_returned;
    sum.primary_hits_reprocessed += report.primary_hits_returned;
    sum.returns += report.returns;
    sum.generators += (orders.tasks & task::generate) != 0 ? 1 : 0;
    sum.shaders += (orders.tasks & task::shade) != 0 ? 1 : 0;
    sum.searchers += (orders.tasks & (task::search | task::walk)) != 0 ? 1 : 0;
    sum.testers += (orders.tasks & task::test) != 0 ? 1 : 0;
  }
  return sum;
}

void StageTeam::throw_if_stopped() {
  for (unsigned spe = 0; spe < plan_.spes.size(); ++spe) {
    if (machine_.running(spe)) continue;
    machine_.wait(spe);
    throw SpeError("SPE " + std::to_string(spe) + " left its program in the middle of its work");
  }
}

} // namespace celltrace
