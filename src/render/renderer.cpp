#include "celltrace/render.hpp"

#include "celltrace/error.hpp"
#include "kernel/build_hierarchy_plan.hpp"
#include "kernel/ray_stack.hpp"
#include "render/frame_setup.hpp"
#include "render/spe_team.hpp"
#include "render/statistics.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

namespace celltrace {

using namespace kernel;

namespace {

class Stopwatch {
public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

MachineConfig machine_config(const RenderOptions& options) {
  check(options);
  MachineConfig config;
  config.backend = options.backend;
  config.spes = options.spes;
  config.simd = options.simd;
  config.emulation = options.emulation;
  // Commands and doorbells that come before the last ones are read must not replace them.
  config.signal_mode[0] = SignalMode::logical_or;
  config.signal_mode[1] = SignalMode::logical_or;
  return config;
}

/// A block that a DMA list can address: all of it in one region of 4 GB.
AlignedBlock make_list_target(std::size_t bytes) {
  AlignedBlock block(bytes);
  const auto region = [](const std::byte* at) { return reinterpret_cast<std::uintptr_t>(at) >> 31 >> 1; };
  // The block that straddles a border is kept while another one is made, which therefore lies elsewhere.
  if (region(block.data()) != region(block.data() + bytes - 1)) return make_list_target(bytes);
  return block;
}

} // namespace

class Renderer::Impl {
public:
  explicit Impl(const RenderOptions& options)
      : options_(options), frame_block_(sizeof(FrameBlock)), frame_(*new (frame_block_.data()) FrameBlock()),
        machine_(make_machine(machine_config(options))) {
    const unsigned spes = machine_->spe_count();
    set_options(frame_, options_, spes);
    surface_ = make_list_target(std::size_t{frame_.surface_pitch} * frame_.packet_rows * kPacketEdge);
    strips_ = AlignedBlock(spes * sizeof(StripRecord));
    reports_ = AlignedBlock(spes * sizeof(ReportRecord));
    frame_.surface = to_ea(surface_.data());
    frame_.strips = to_ea(strips_.data());
    frame_.reports = to_ea(reports_.data());
    hand_out(even_strips(frame_.packet_rows, spes));
    team_ = std::make_unique<SpeTeam>(*machine_, frame_);
  }
  ~Impl() {
    // Some rules are for the end of a program.
    team_.reset();
    new_diagnostics();
  }

  RenderResult render(const Scene& scene, const Progress& progress) {
    return reporting_failures([&] { return render_scene(scene, progress); });
  }
  RenderResult render(const Camera& camera, const Progress& progress) {
    return reporting_failures([&] { return render_camera(camera, progress); });
  }

private:
  template <class Work> RenderResult reporting_failures(Work work) {
    try {
      return work();
    } catch (...) {
      new_diagnostics();
      throw;
    }
  }
  /// What the machine has found since the last call; the caller's function hears of it.
  std::vector<Diagnostic> new_diagnostics() {
    std::vector<Diagnostic> found = machine_->diagnostics();
    found.erase(found.begin(),
                found.begin() + static_cast<std::ptrdiff_t>(std::exchange(known_diagnostics_, found.size())));
    if (options_.diagnostic) std::for_each(found.begin(), found.end(), options_.diagnostic);
    return found;
  }

  RenderResult render_scene(const Scene& scene, const Progress& progress) {
    RenderStatistics statistics;
    const Stopwatch build;
    image_.assign(scene, scratch_, machine_->direct_memory() ? machine_->spe_count() : 1);
    scene_ = scene;
    statistics.build_seconds = build.seconds();
    const Stopwatch prepare;
    const SpeMeter meter(*machine_);
    build_accelerator();
    statistics.prepare_seconds = prepare.seconds();
    statistics.prepare_cycles = elapsed_cycles(meter.read());
    return render_frame(scene.camera, statistics, progress);
  }

  RenderResult render_camera(const Camera& camera, const Progress& progress) {
    if (image_.empty()) throw InputError("a camera alone cannot be rendered: there is no scene yet");
    validate(camera);
    RenderStatistics statistics;
    return render_frame(camera, statistics, progress);
  }

  void hand_out(const std::vector<UnitRange>& strips) {
    for (std::size_t spe = 0; spe < strips.size(); ++spe)
      strip(spe) = {strips[spe].first, strips[spe].first + strips[spe].count, {0, 0}};
  }
  StripRecord& strip(std::size_t spe) { return reinterpret_cast<StripRecord*>(strips_.data())[spe]; }
  const ReportRecord& report(std::size_t spe) const {
    return reinterpret_cast<const ReportRecord*>(reports_.data())[spe];
  }

  void build_accelerator() {
    if (static_cast<AcceleratorKind>(frame_.accelerator) == AcceleratorKind::hierarchy)
      build_hierarchy();
    else
      build_grid();
    team_->synchronize();
  }
  void build_grid() {
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
      reserve_work(words);
      if (team_->prepare_frame()) break;
      pairs = report(0).list_entries;
    }
    frame_.grid.list_count = report(0).list_entries;
  }
  void build_hierarchy() {
    const std::uint32_t objects = image_.header().object_count;
    // A node has four children, and a leaf at least one object.
    const std::uint32_t nodes = objects / 3 + 2;
    image_.reserve_accelerator(std::uint64_t{nodes} * sizeof(NodeRecord), objects);
    frame_.hierarchy = {image_.table_offset(), nodes, 0, image_.list_offset()};
    const ImageHeader& header = image_.header();
    reserve_work(hierarchy::WorkSize(objects, header.run_count, header.longest_run).pairs());
    if (machine_->direct_memory()) {
      build_hierarchy_on(*team_, machine_->spe_count());
    } else {
      // The builder follows pointers through main memory: work for the PPE's side where SPEs cannot.
      // No more of them than there are reports in the frame.
      MachineConfig host;
      host.spes = std::clamp(std::thread::hardware_concurrency(), 1u, machine_->spe_count());
      const std::unique_ptr<Machine> machine = make_machine(host);
      SpeTeam team(*machine, frame_);
      build_hierarchy_on(team, host.spes);
    }
    frame_.hierarchy.node_count = report(0).list_entries;
  }
  void build_hierarchy_on(SpeTeam& team, unsigned spes) {
    if (image_.header().run_count == 0) spes = 1;
    frame_.prepare_spes = std::min(spes, hierarchy::kMaxBuilders);
    frame_.prepare_step = 0;
    const std::uint32_t steps = frame_.prepare_spes == 1 ? 1 : hierarchy::kSteps;
    for (; frame_.prepare_step < steps; ++frame_.prepare_step)
      team.prepare_frame(frame_.prepare_spes);
  }
  /// Work memory of PREPARE FRAME, and what else depends on the scene.
  void reserve_work(std::uint64_t pairs) {
    frame_.sort_capacity = static_cast<std::uint32_t>(pairs);
    for (int i = 0; i < 2; ++i) {
      sort_buffers_[i].reserve(std::size_t{pairs} * 8);
      frame_.sort_buffer[i] = to_ea(sort_buffers_[i].data());
    }
    set_scene(frame_, scene_, options_, image_);
    // A tree of n levels needs n + 1 nodes; straight transmission may add some that cost no level.
    const std::uint32_t nodes = frame_.max_trace_level + 32;
    if (nodes != frame_.ray_stack_nodes) {
      frame_.ray_stack_nodes = nodes;
      ray_stack_ = AlignedBlock(std::size_t{machine_->spe_count()} * nodes * kRayNodeBytes);
      frame_.ray_stack = to_ea(ray_stack_.data());
    }
  }

  RenderResult render_frame(const Camera& camera, RenderStatistics& statistics, const Progress& progress) {
    set_camera(frame_, camera, scene_, image_);
    ++frame_.epoch;
    std::memset(surface_.data(), 0, surface_.size());
    std::memset(reports_.data(), 0, reports_.size());
    const Stopwatch render;
    const SpeMeter meter(*machine_);
    RenderResult result;
    StripTally tally(machine_->spe_count(), frame_.packet_rows);
    result.complete = team_->render_frame(tally, progress);
    statistics.render_seconds = render.seconds();
    if (result.complete) hand_out(tally.next_strips());
    if (machine_->backend() == "cell_emu") {
      statistics.schedule = options_.emulation.schedule;
      statistics.seed = options_.emulation.seed;
    }
    collect(statistics, *machine_, frame_,
            {reinterpret_cast<const ReportRecord*>(reports_.data()), strip_count()}, meter.read());
    statistics.diagnostics = new_diagnostics();
    result.statistics = statistics;
    result.image = copy_picture();
    return result;
  }
  std::size_t strip_count() const { return machine_->spe_count(); }

  Image copy_picture() const {
    Image image(options_.width, options_.height);
    for (int y = 0; y < options_.height; ++y)
      std::memcpy(image.pixel(0, y),
                  surface_.data() + std::size_t{frame_.surface_pitch} * static_cast<std::size_t>(y),
                  static_cast<std::size_t>(options_.width) * 4);
    return image;
  }

  RenderOptions options_;
  Scene scene_;
  SceneImage image_;
  AlignedBlock scratch_;
  // Everything from here to the machine is read and written by the SPEs.
  AlignedBlock surface_, strips_, reports_, ray_stack_, sort_buffers_[2];
  AlignedBlock frame_block_;
  FrameBlock& frame_;
  std::unique_ptr<Machine> machine_;
  std::unique_ptr<SpeTeam> team_;
  std::size_t known_diagnostics_ = 0;
};

Renderer::Renderer(const RenderOptions& options) : impl_(std::make_unique<Impl>(options)) {
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

RenderResult Renderer::render(const Scene& scene, const Progress& progress) {
  return impl_->render(scene, progress);
}
RenderResult Renderer::render(const Camera& camera, const Progress& progress) {
  return impl_->render(camera, progress);
}

RenderResult render(const Scene& scene, const RenderOptions& options, const Progress& progress) {
  return Renderer(options).render(scene, progress);
}

} // namespace celltrace
