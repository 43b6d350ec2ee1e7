#include "render/accelerator_builder.hpp"

#include "celltrace/error.hpp"
#include "kernel/direct/build_bvh_plan.hpp"
#include "kernel/tuning.hpp"
#include "render/frame_setup.hpp"
#include "render/held_progress.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>

namespace celltrace {

using namespace kernel;

namespace {

/// Share of a BVH's building time before the first treelet, in which the nodes above the treelets are built.
constexpr double kBeforeTreelets = 0.15;
/// Limit on a block of work memory that is kept between frames, in bytes; larger blocks are freed.
constexpr std::size_t kKeptBytes = std::size_t{256} << 20;

/// Limit on changed lines, as a multiple of the lines in a cache. If there are more, hardly any cached line
/// is worth keeping: SPEs get no list and discard all lines.
constexpr std::uint64_t kLinesWorthMarking = 16;

/// Reports the progress of building a BVH, which it reads in the BVH's work memory.
class BvhProgress {
public:
  BvhProgress(const AlignedBlock& work, const Progress& go_on)
      : team_(*reinterpret_cast<bvh::TeamRecord*>(work.data())), go_on_(go_on) {}

  /// Reports progress; if the caller ends the build, makes the SPEs take and copy no more treelets.
  /// `treelets` tells whether the build has come to the treelets.
  void poll(bool treelets) {
    if (stopped() || go_on_.report(treelets ? fraction() : 0)) return;
    if (!treelets) return;
    std::atomic_ref(team_.next).store(bvh::kStopped, std::memory_order_relaxed);
    std::atomic_ref(team_.next_copy).store(bvh::kStopped, std::memory_order_relaxed);
  }
  bool stopped() const { return go_on_.stopped(); }
  void rethrow() const { go_on_.rethrow(); }

private:
  double fraction() const {
    const double done = std::min(std::atomic_ref(team_.next).load(std::memory_order_relaxed), team_.treelets);
    return kBeforeTreelets + (1 - kBeforeTreelets) * done / std::max(team_.treelets, 1u);
  }

  bvh::TeamRecord& team_;
  HeldProgress go_on_;
};

} // namespace

void AcceleratorBuilder::make_image(const Scene& scene, const ImageMemory& memory) {
  image_.assign(scene, work_[0], host_threads(), SceneImage::kObjectsAThread, memory);
}

bool AcceleratorBuilder::update_image(const Scene& scene, const SceneChanges& changes) {
  if (static_cast<AcceleratorKind>(frame_.accelerator) != AcceleratorKind::bvh) return false;
  if (!machine_.direct_memory()) shared_image_.remember();
  return changes.objects ? image_.update(scene, work_[0], host_threads()) : image_.update_surfaces(scene);
}

bool AcceleratorBuilder::update_boundaries(const Scene& scene) {
  if (static_cast<AcceleratorKind>(frame_.accelerator) != AcceleratorKind::bvh) return false;
  if (!machine_.direct_memory()) shared_image_.remember();
  return image_.update_boundaries(scene);
}

std::optional<std::uint64_t> AcceleratorBuilder::update(const SceneChanges& changes) {
  if (changes.objects) {
    refit_.refit(image_.mutable_base(), frame_.bvh, host_threads());
    if (refit_.decay() > tuning::kMostDecay) return std::nullopt;
  }
  frame_.image = shared_image_.ea();
  if (machine_.direct_memory()) {
    team_.synchronize({});
    return 0;
  }
  const std::vector<std::uint32_t> lines = shared_image_.publish_changes();
  const std::uint64_t cached = std::uint64_t{frame_.cache_ways} * frame_.cache_sets;
  if (lines.size() > kLinesWorthMarking * cached)
    team_.synchronize();
  else
    team_.synchronize(lines);
  return lines.size();
}

/// Returns the number of threads for work on the host.
unsigned AcceleratorBuilder::host_threads() const {
  return machine_.direct_memory() ? machine_.spe_count() : 1;
}

bool AcceleratorBuilder::build(const Progress& go_on) {
  refit_.forget();
  const bool built = static_cast<AcceleratorKind>(frame_.accelerator) == AcceleratorKind::bvh
                         ? build_bvh(go_on)
                         : build_grid();
  for (AlignedBlock& block : work_)
    if (block.size() > kKeptBytes) block = AlignedBlock();
  team_.synchronize();
  return built && (!go_on || go_on(1));
}

bool AcceleratorBuilder::build_grid() {
  const GridRecord grid = choose_grid(image_.header());
  const std::uint32_t cells = grid.row_of_cells * grid.cells[2];
  std::uint64_t pairs = std::max<std::uint64_t>(std::uint64_t{image_.header().object_count} * 6, 1024);
  for (;;) {
    if (pairs > 0x3FFFFFFF) throw InputError("the scene is too large: its object lists would pass 4 GB");
    const auto words = static_cast<std::uint32_t>(pairs);
    image_.reserve_accelerator(std::uint64_t{cells} * sizeof(CellRecord), words);
    frame_.grid = grid;
    frame_.grid.cell_offset = image_.table_offset();
    frame_.grid.list_offset = image_.list_offset();
    frame_.grid.list_capacity = words;
    enter_work_memory(words);
    shared_image_.publish_static();
    frame_.image = shared_image_.ea();
    const bool built = team_.prepare_frame(1, {});
    reports_.fetch();
    if (built) break;
    pairs = reports_[0].list_entries;
  }
  frame_.grid.list_count = reports_[0].list_entries;
  return true;
}

bool AcceleratorBuilder::build_bvh(const Progress& go_on) {
  const ImageHeader& header = image_.header();
  const std::uint32_t objects = header.object_count;
  const bvh::WorkSize work(objects, header.group_count, header.longest_group);
  const std::uint32_t nodes = bvh::most_nodes(objects, header.group_count, header.prototype_count != 0);
  image_.reserve_accelerator(std::uint64_t{nodes} * sizeof(NodeRecord), objects);
  frame_.bvh = {image_.table_offset(), nodes, 0, image_.list_offset()};
  frame_.large_leaves = machine_.direct_memory() && objects <= tuning::kMostObjectsOfLargeLeaves;
  frame_.far_nodes = machine_.direct_memory() && objects > tuning::kMostObjectsOfNearNodes;
  enter_work_memory(work.pairs());
  frame_.image = to_ea(image_.base());
  // The builder follows pointers through main memory, so that it runs on the host if SPEs cannot.
  if (!machine_.direct_memory()) return build_bvh_for_spes(go_on);
  const bool built = build_bvh_on(team_, frame_, machine_.spe_count(), go_on);
  frame_.bvh.node_count = reports_[0].list_entries;
  return built;
}

bool AcceleratorBuilder::build_bvh_for_spes(const Progress& go_on) {
  MachineConfig host;
  host.spes = std::clamp(std::thread::hardware_concurrency(), 1u, bvh::kMaxBuilders);
  const std::unique_ptr<Machine> machine = make_machine(host);
  SharedRecords<ReportRecord> reports(host.spes, machine->byte_order());
  SharedRecords<FrameBlock> frame(1, machine->byte_order());
  frame[0] = frame_;
  frame[0].reports = reports.ea();
  SpeTeam team(*machine, frame);
  const bool built = build_bvh_on(team, frame[0], host.spes, go_on);
  frame_.bvh.node_count = reports[0].list_entries;
  if (!built) return false;
  shared_image_.publish_all();
  frame_.image = shared_image_.ea();
  return true;
}

bool AcceleratorBuilder::build_bvh_on(SpeTeam& team, FrameBlock& frame, unsigned spes,
                                      const Progress& go_on) {
  BvhProgress progress(work_[0], go_on);
  // A few objects are not worth sharing among SPEs.
  const unsigned builders = frame_.group_count == 0 ? 1 : std::min(spes, bvh::kMaxBuilders);
  // A build in steps lets SPEs wait for each other, and can be stopped.
  const bool at_once = builders == 1 && !go_on;
  frame.prepare_spes = at_once ? 0 : builders;
  frame.prepare_step = 0;
  const std::uint32_t steps = at_once || frame_.group_count == 0 ? 1 : bvh::kSteps;
  std::function<void()> poll;
  if (go_on) poll = [&] { progress.poll(frame.prepare_step != 0); };
  for (; frame.prepare_step < steps && !progress.stopped(); ++frame.prepare_step)
    team.prepare_frame(builders, poll);
  progress.rethrow();
  return !progress.stopped();
}

void AcceleratorBuilder::enter_work_memory(std::uint64_t pairs) {
  frame_.work_entries = static_cast<std::uint32_t>(pairs);
  for (int i = 0; i < 2; ++i) {
    work_[i].reserve(static_cast<std::size_t>(pairs) * 8);
    frame_.work_memory[i] = reinterpret_cast<std::uintptr_t>(work_[i].data());
  }
}

} // namespace celltrace
