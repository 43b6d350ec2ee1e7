#include "celltrace/render.hpp"

#include "celltrace/error.hpp"
#include "kernel/strategy.hpp"
#include "records/accelerator.hpp"
#include "records/frame.hpp"
#include "records/report.hpp"
#include "records/sampling.hpp"
#include "render/frame_plan.hpp"
#include "render/frame_setup.hpp"
#include "render/machine_diagnostics.hpp"
#include "render/models/stage_team.hpp"
#include "render/picture_memory.hpp"
#include "render/picture_options.hpp"
#include "render/report_pace.hpp"
#include "render/scene_preparation.hpp"
#include "render/spe_team.hpp"
#include "render/statistics.hpp"
#include "render/stopwatch.hpp"
#include "render/unit_blocks.hpp"
#include "render/work_plan.hpp"

#include <algorithm>
#include <new>
#include <span>
#include <system_error>
#include <utility>

namespace celltrace {

using namespace kernel;

namespace {

MachineConfig machine_config(const RenderOptions& options) {
  check(options);
  MachineConfig config;
  config.backend = options.backend;
  config.spes = machine_spes(options);
  config.simd = options.simd;
  config.emulation = options.emulation;
  // Commands and doorbells are combined by OR, so that a new one does not replace an earlier one that has not
  // been read.
  config.signal_mode[0] = SignalMode::logical_or;
  config.signal_mode[1] = SignalMode::logical_or;
  return config;
}

} // namespace

class Renderer::Impl {
  static_assert(kRowStep == kSampledEdge, "blocks of samples are whole");

public:
  explicit Impl(const RenderOptions& options) : Impl(options, make_machine(machine_config(options))) {}
  ~Impl() {
    scene_.retire_queries();
    // Ends the programs, because some rules are only checked at the end of a program.
    team_.reset();
    diagnostics_.take();
  }

  /// Returns a function that reports a call's progress, and ends the call after RenderOptions::most_seconds.
  /// `progress` must outlive this function.
  Progress within_time(const Progress& progress) const {
    if (options_.most_seconds == 0) return progress;
    return [&progress, watch = Stopwatch(), most = options_.most_seconds](double fraction) {
      return watch.seconds() < most && (!progress || progress(fraction));
    };
  }
  RenderResult render(const Scene& scene, const Progress& progress) {
    check_room_for_all();
    if (!prepare(scene, progress)) return no_frame();
    return diagnostics_.reporting_failures([&] { return render_frame(picture_.rows(), progress); });
  }
  /// Prepares a scene. Returns false if `progress` ended the preparation.
  bool prepare(const Scene& scene, const Progress& progress) {
    plan_.forget_points();
    return scene_.prepare(scene, progress);
  }
  RenderResult render_rows(int top, int bottom, const Progress& progress) {
    return diagnostics_.reporting_failures([&] {
      if (!scene_.has_scene()) throw InputError("rows cannot be rendered: no scene is prepared");
      const RowRange picture = picture_.rows();
      const auto ends_block = [&](int row) { return row % kRowStep == 0 || row == picture.bottom; };
      if (top < 0 || top >= bottom || bottom > picture.bottom || top % kRowStep != 0 || !ends_block(bottom))
        throw InputError("the rows to render are not whole blocks of the picture's");
      if (options_.model != Model::shared && (top != 0 || bottom != picture.bottom))
        throw InputError("rows are rendered one after the other by the shared programming model only");
      if (options_.rows_at_once != 0 && bottom - top > options_.rows_at_once)
        throw InputError("the rows to render are more than RenderOptions::rows_at_once");
      return render_frame({top, bottom}, progress);
    });
  }
  RenderResult render(const Scene& scene, const SceneChanges& changes, const Progress& progress) {
    check_room_for_all();
    plan_.forget_points();
    if (!scene_.prepare(scene, changes, progress)) return no_frame();
    return diagnostics_.reporting_failures([&] { return render_frame(picture_.rows(), progress); });
  }
  RenderResult render(const Camera& camera, const Progress& progress) {
    return diagnostics_.reporting_failures([&] { return render_camera(camera, progress); });
  }
  void set_picture(const RenderOptions& given) {
    const RenderOptions options = with_picture_of(options_, given);
    check(options);
    options_ = options;
    make_room_for_picture();
    scene_.follow_picture();
    plan_.forget_points();
    // Another picture may need more or less of the SPEs' local stores.
    if (!stages_) team_->synchronize({});
  }
  RayQueries ray_queries() {
    if (!options_.ray_queries) throw InputError("ray queries need RenderOptions::ray_queries");
    return scene_.ray_queries();
  }
  /// Renders the only frame of this renderer.
  RenderResult render_once(const Scene& scene, const Progress& progress) {
    is_last_frame_ = true;
    scene_.expect_last_frame();
    return render(scene, progress);
  }

private:
  Impl(const RenderOptions& options, std::unique_ptr<Machine> machine)
      : options_(options), reports_(machine->spe_count(), machine->byte_order()),
        frame_block_(1, machine->byte_order()), frame_(frame_block_[0]),
        picture_(options_, frame_, machine->byte_order()), plan_(options_, *machine, frame_, picture_),
        diagnostics_(*machine, options_), scene_(options_, *machine, frame_, reports_, diagnostics_),
        machine_(std::move(machine)) {
    make_room_for_picture();
    team_ =
        std::make_unique<SpeTeam>(*machine_, frame_block_, static_cast<AcceleratorKind>(frame_.accelerator));
    if (options_.model != Model::shared)
      stages_ = std::make_unique<StageTeam>(*machine_, frame_block_, options_.model);
    scene_.set_teams(*team_, stages_.get());
  }

  /// Allocates memory that depends on the size and the kind of pictures.
  void make_room_for_picture() {
    set_options(frame_, options_, *machine_);
    picture_.make_room(machine_->spe_count(), bundle_edge(machine_->direct_memory()));
    frame_.reports = reports_.ea();
    plan_.forget();
    RowRange rows = picture_.rows();
    if (options_.rows_at_once != 0) rows.bottom = std::min(rows.bottom, options_.rows_at_once);
    plan_.plan(rows);
  }

  /// Returns the result of a frame that is cancelled before the first pixel.
  RenderResult no_frame() {
    picture_.clear_from(0);
    reports_.clear();
    RenderResult result;
    result.complete = false;
    RenderStatistics statistics = scene_.take_statistics();
    collect(statistics, *machine_, frame_, reports_.all(), SpeMeter(*machine_).read());
    result.statistics = statistics;
    picture_.copy(picture_.rows(), scene_.image(), result);
    return result;
  }

  RenderResult render_camera(const Camera& camera, const Progress& progress) {
    if (!scene_.knows_scene()) throw InputError("a camera alone cannot be rendered: there is no scene yet");
    check_room_for_all();
    plan_.forget_points();
    if (!scene_.prepare(camera, progress)) return no_frame();
    return render_frame(picture_.rows(), progress);
  }

  /// Throws InputError if memory cannot hold all rows.
  void check_room_for_all() const {
    if (options_.rows_at_once != 0 && picture_.rows().bottom > options_.rows_at_once)
      throw InputError("the picture has more rows than RenderOptions::rows_at_once: render_rows() is for it");
  }

  RenderResult render_frame(const RowRange& rows, const Progress& progress) {
    RenderStatistics statistics = scene_.take_statistics();
    plan_.plan(rows);
    plan_.forget_points();
    // Clears the picture only for a frame that can be ended: any other frame writes all pixels.
    if (progress) picture_.clear_from(plan_.kept_lines());
    const Stopwatch render;
    const SpeMeter meter(*machine_);
    RenderResult result;
    std::vector<ReportRecord> reports(machine_->spe_count());
    if (options_.antialiasing) {
      const double grid_share = grid_share_;
      frame_.purpose = static_cast<std::uint32_t>(FramePurpose::grid);
      result.complete = render_pass(plan_.grid(), part_of(progress, 0, grid_share), reports);
      const double grid_seconds = render.seconds();
      picture_.keep_colours(rows);
      if (result.complete) {
        plan_.keep_points(rows);
        frame_.purpose = static_cast<std::uint32_t>(FramePurpose::samples);
        result.complete = render_pass(plan_.samples(), part_of(progress, grid_share, 1), reports);
        if (result.complete) grid_share_ = grid_seconds / render.seconds();
      }
    } else {
      result.complete = render_pass(plan_.grid(), progress, reports);
      picture_.keep_colours(rows);
    }
    statistics.render_seconds = render.seconds();
    if (machine_->backend() != Backend::native) {
      statistics.schedule = options_.emulation.schedule;
      statistics.seed = options_.emulation.seed;
    }
    collect(statistics, *machine_, frame_, reports, meter.read());
    statistics.height = rows.bottom - rows.top;
    statistics.model = options_.model;
    if (stages_) statistics.stages = stages_->counts();
    scene_.describe(statistics);
    statistics.diagnostics = diagnostics_.take();
    result.statistics = statistics;
    // Frees the image first, so that the picture can reuse its memory; first hits still need the image's
    // tables.
    if (is_last_frame_ && !options_.first_hits) scene_.release_image();
    picture_.copy(rows, scene_.image(), result);
    if (options_.work_map) result.work = std::move(work_);
    return result;
  }

  /// Renders a pass on the SPEs, and adds each SPE's report to `reports`. Returns false if `progress` ended
  /// the pass.
  bool render_pass(WorkPlan& plan, const Progress& progress, std::span<ReportRecord> reports) {
    reports_.clear();
    ++frame_.epoch;
    plan.place(frame_);
    frame_.units_per_word = units_per_word(plan.units(), static_cast<bool>(progress));
    StripTally tally(machine_->spe_count(), plan.units());
    const BlockGrid blocks = picture_.blocks(bundle_edge(machine_->direct_memory()));
    std::vector<std::pair<std::uint32_t, unsigned>> done; // units, and the SPE that completed each
    const auto unit_done = [&](std::uint32_t unit, unsigned spe) {
      done.emplace_back(unit, spe);
      if (options_.finished_block) picture_.report_blocks(regions_of(plan.unit(unit), blocks), spe);
    };
    const Stopwatch pass;
    const bool complete =
        stages_ ? stages_->render_frame(progress) : team_->render_frame(tally, progress, unit_done);
    if (complete) report_pace().learn(plan.units(), pass.seconds());
    if (complete && stages_ && options_.finished_block) picture_.report_blocks({region_of(options_)}, 0);
    work_ = work_of(plan, done, blocks);
    reports_.fetch();
    add(reports, reports_.all());
    if (complete && !stages_) plan.learn();
    return complete;
  }

  /// Returns FrameBlock::units_per_word. On emulated machines the result does not depend on the host's time.
  std::uint32_t units_per_word(std::uint32_t units, bool is_requested) {
    if (options_.finished_block || options_.work_map) return kEachUnit;
    if (!machine_->direct_memory()) return units / 64 + 1;
    return is_requested ? report_pace().units_per_word(units) : 0;
  }
  ReportPace& report_pace() {
    return static_cast<FramePurpose>(frame_.purpose) == FramePurpose::samples ? sample_pace_ : pace_;
  }

  static std::vector<WorkRecord> work_of(WorkPlan& plan,
                                         const std::vector<std::pair<std::uint32_t, unsigned>>& done,
                                         const BlockGrid& blocks) {
    std::vector<WorkRecord> work;
    if (done.empty()) return work;
    const std::vector<double> costs = plan.measured_costs();
    for (const auto& [unit, spe] : done) {
      const std::vector<PictureRegion> regions = regions_of(plan.unit(unit), blocks);
      double pixels = 0;
      for (const PictureRegion& region : regions)
        pixels += double{1} * (region.right - region.left) * (region.bottom - region.top);
      for (const PictureRegion& region : regions)
        work.push_back({region, spe, costs[unit] / pixels});
    }
    return work;
  }
  RenderOptions options_;
  // The SPEs read and write all members from here up to the machine.
  SharedRecords<ReportRecord> reports_;
  SharedRecords<FrameBlock> frame_block_;
  FrameBlock& frame_; ///< the host's view of the frame block
  PictureMemory picture_;
  FramePlan plan_;
  MachineDiagnostics diagnostics_;
  ScenePreparation scene_;
  std::unique_ptr<Machine> machine_;
  std::unique_ptr<SpeTeam> team_;
  std::unique_ptr<StageTeam> stages_;
  ReportPace pace_, sample_pace_; ///< pace of the passes of the two plans
  double grid_share_ = 0.5;       ///< share of the grid in the time of the last picture with antialiasing
  std::vector<WorkRecord> work_;  ///< records of the last pass
  bool is_last_frame_ = false;
};

Renderer::Renderer(const RenderOptions& options) {
  try {
    impl_ = std::make_unique<Impl>(options);
  } catch (const std::bad_alloc&) {
    throw OutOfMemory();
  } catch (const std::system_error& error) {
    throw Error(std::string("the SPEs' threads cannot be started: ") + error.what());
  }
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

RenderResult Renderer::render(const Scene& scene, const Progress& progress) {
  return impl_->render(scene, impl_->within_time(progress));
}
RenderResult Renderer::render(const Camera& camera, const Progress& progress) {
  return impl_->render(camera, impl_->within_time(progress));
}

RenderResult Renderer::render(const Scene& scene, const SceneChanges& changes, const Progress& progress) {
  return impl_->render(scene, changes, impl_->within_time(progress));
}

void Renderer::set_picture(const RenderOptions& options) {
  impl_->set_picture(options);
}

bool Renderer::prepare(const Scene& scene) {
  return impl_->prepare(scene, impl_->within_time({}));
}
RayQueries Renderer::ray_queries() const {
  return impl_->ray_queries();
}
RenderResult Renderer::render_rows(int top, int bottom, const Progress& progress) {
  return impl_->render_rows(top, bottom, impl_->within_time(progress));
}

RenderResult render(const Scene& scene, const RenderOptions& options, const Progress& progress) {
  Renderer renderer(options);
  return renderer.impl_->render_once(scene, renderer.impl_->within_time(progress));
}

} // namespace celltrace
