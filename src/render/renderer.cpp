#include "celltrace/render.hpp"

#include "celltrace/error.hpp"
#include "kernel/lights/list.hpp"
#include "kernel/shading/ray_stack.hpp"
#include "prepare/scene_origin.hpp"
#include "render/accelerator_builder.hpp"
#include "render/camera_setup.hpp"
#include "render/frame_plan.hpp"
#include "render/frame_setup.hpp"
#include "render/models/stage_team.hpp"
#include "render/picture_memory.hpp"
#include "render/picture_options.hpp"
#include "render/quality.hpp"
#include "render/ray_query_scene.hpp"
#include "render/report_pace.hpp"
#include "render/spe_team.hpp"
#include "render/statistics.hpp"
#include "render/unit_blocks.hpp"
#include "render/work_plan.hpp"
#include "scene/build_watch.hpp"

#include <algorithm>
#include <chrono>
#include <new>
#include <span>
#include <system_error>
#include <type_traits>
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
  config.spes = machine_spes(options);
  config.simd = options.simd;
  config.emulation = options.emulation;
  // Commands and doorbells that come before the last ones are read must not replace them.
  config.signal_mode[0] = SignalMode::logical_or;
  config.signal_mode[1] = SignalMode::logical_or;
  return config;
}

/// Of building, what the scene image takes.
constexpr double kImageShare = 0.2;

} // namespace

class Renderer::Impl {
  static_assert(kRowStep == kSampledEdge, "blocks of samples are whole");

public:
  explicit Impl(const RenderOptions& options) : Impl(options, make_machine(machine_config(options))) {}
  ~Impl() {
    retire_queries();
    // Some rules are for the end of a program.
    team_.reset();
    new_diagnostics();
  }

  /// Returns what hears of a call's progress, which ends it after RenderOptions::most_seconds. The caller's
  /// has to live as long.
  Progress within_time(const Progress& progress) const {
    if (options_.most_seconds == 0) return progress;
    return [&progress, watch = Stopwatch(), most = options_.most_seconds](double fraction) {
      return watch.seconds() < most && (!progress || progress(fraction));
    };
  }
  RenderResult render(const Scene& scene, const Progress& progress) {
    check_room_for_all();
    if (!prepare(scene, progress)) return no_frame();
    return reporting_failures([&] { return render_frame(picture_.rows(), progress); });
  }
  /// `progress` may end it, too.
  bool prepare(const Scene& scene, const Progress& progress) {
    return while_wanted(progress, scene, [&](const Scene& wanted, const Progress& go_on) {
      return prepare_scene(wanted, go_on);
    });
  }
  RenderResult render_rows(int top, int bottom, const Progress& progress) {
    return reporting_failures([&] {
      if (!has_scene_) throw InputError("rows cannot be rendered: no scene is prepared");
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
    is_edited_ = true;
    if (!changes.objects && !changes.surfaces && enter_moved_camera(scene.camera))
      return reporting_failures([&] { return render_frame(picture_.rows(), progress); });
    const bool prepared = while_wanted(progress, scene, [&](const Scene& wanted, const Progress& go_on) {
      return prepare_changes(wanted, changes, go_on);
    });
    if (!prepared) return no_frame();
    return reporting_failures([&] { return render_frame(picture_.rows(), progress); });
  }
  RenderResult render(const Camera& camera, const Progress& progress) {
    return reporting_failures([&] { return render_camera(camera, progress); });
  }
  void set_picture(const RenderOptions& given) {
    const RenderOptions options = with_picture_of(options_, given);
    check(options);
    options_ = options;
    make_room_for_picture();
    if (has_scene_) enter_camera(camera_);
    // What it takes of their local stores may be more or less.
    if (!stages_) team_->synchronize({});
  }
  RayQueries ray_queries() {
    if (!options_.ray_queries) throw InputError("ray queries need RenderOptions::ray_queries");
    if (!has_scene_) throw InputError("ray queries need a scene: none is prepared");
    if (static_cast<AcceleratorKind>(frame_.accelerator) != AcceleratorKind::bvh)
      throw InputError("ray queries need a BVH: the scene's accelerator is a grid");
    if (!query_scene_)
      query_scene_ = std::make_shared<RayQueryScene>(frame_, image_, origin_,
                                                     machine_->direct_memory() ? machine_->spu_key()
                                                                               : make_machine({})->spu_key());
    return RayQueryScene::queries(query_scene_);
  }
  /// The only frame of this renderer.
  RenderResult render_once(const Scene& scene, const Progress& progress) {
    is_last_frame_ = true;
    return render(scene, progress);
  }

private:
  Impl(const RenderOptions& options, std::unique_ptr<Machine> machine)
      : options_(options), reports_(machine->spe_count(), machine->byte_order()),
        frame_block_(1, machine->byte_order()), frame_(frame_block_[0]),
        picture_(options_, frame_, machine->byte_order()), plan_(options_, *machine, frame_, picture_),
        machine_(std::move(machine)) {
    make_room_for_picture();
    team_ =
        std::make_unique<SpeTeam>(*machine_, frame_block_, static_cast<AcceleratorKind>(frame_.accelerator));
    builder_ = std::make_unique<AcceleratorBuilder>(*machine_, *team_, frame_, reports_, image_);
    if (options_.model != Model::shared)
      stages_ = std::make_unique<StageTeam>(*machine_, frame_block_, options_.model);
  }

  /// The scene will not be what they were made for.
  void retire_queries() noexcept {
    if (query_scene_) query_scene_->retire();
    query_scene_.reset();
  }

  /// What depends on the size and the kind of pictures.
  void make_room_for_picture() {
    set_options(frame_, options_, *machine_);
    picture_.make_room(machine_->spe_count(), bundle_edge(machine_->direct_memory()));
    frame_.reports = reports_.ea();
    plan_.forget();
    RowRange rows = picture_.rows();
    if (options_.rows_at_once != 0) rows.bottom = std::min(rows.bottom, options_.rows_at_once);
    plan_.plan(rows);
  }

  template <class Work> std::invoke_result_t<Work> reporting_failures(Work work) {
    try {
      return work();
    } catch (const std::bad_alloc&) {
      new_diagnostics();
      throw OutOfMemory();
    } catch (...) {
      new_diagnostics();
      throw;
    }
  }
  /// Calls work(scene, go_on), with the scene that the picture's quality leaves of `scene`, at its origin,
  /// and with what hears of building. False, and there is no scene then, if that has ended it.
  template <class Work> bool while_wanted(const Progress& progress, const Scene& scene, Work work) {
    return while_building(progress, [&](const Progress& go_on) {
      const Vec3 origin = origin_for(scene);
      if (origin != origin_) forget_scene();
      origin_ = origin;
      const auto work_at_origin = [&](const Scene& wanted) {
        const std::optional<Scene> moved = moved_to(origin, wanted);
        return work(moved ? *moved : wanted, go_on);
      };
      if (options_.quality >= kFullQuality) return work_at_origin(scene);
      validate(scene);
      return work_at_origin(at_quality(scene, options_.quality));
    });
  }
  /// Calls work(go_on) in the same way.
  template <class Work> bool while_building(const Progress& progress, Work work) {
    Progress go_on;
    if (options_.build_progress || progress)
      go_on = [&, reached = 0.0](double fraction) mutable {
        reached = std::max(reached, fraction); // whoever says so
        return (!options_.build_progress || options_.build_progress(reached)) && (!progress || progress(0));
      };
    const Progress of_image = part_of(go_on, 0, kImageShare);
    const BuildWatch watch(of_image);
    try {
      const bool is_built = reporting_failures([&] { return work(part_of(go_on, kImageShare, 1)); });
      if (!is_built) forget_scene();
      return is_built;
    } catch (const Cancelled&) {
      forget_scene();
      return false;
    } catch (...) {
      if (watch.has_stopped()) forget_scene();
      throw;
    }
  }
  void forget_scene() {
    has_scene_ = false;
    kept_.reset();
  }
  /// What the machine has found since the last call; the caller's function hears of it.
  std::vector<Diagnostic> new_diagnostics() {
    std::vector<Diagnostic> found = machine_->diagnostics();
    found.erase(found.begin(),
                found.begin() + static_cast<std::ptrdiff_t>(std::exchange(known_diagnostics_, found.size())));
    if (options_.diagnostic) std::for_each(found.begin(), found.end(), options_.diagnostic);
    return found;
  }

  /// Image and accelerator. False: `go_on` cancelled.
  bool prepare_scene(const Scene& scene, const Progress& go_on) {
    prepared_ = RenderStatistics();
    const Stopwatch build;
    retire_queries();
    builder_->make_image(scene, {is_edited_, options_.ray_queries, !is_last_frame_, options_.most_memory});
    keep_for_other_eyes(scene);
    has_scene_ = false;
    media_ = media_of(scene);
    prepared_.build_seconds = build.seconds();
    const Stopwatch prepare;
    const SpeMeter meter(*machine_);
    enter_scene(scene);
    team_->assemble();
    if (!builder_->build(go_on)) return false;
    if (stages_) team_->dismiss(); // the SPEs get other programs
    has_scene_ = true;
    prepared_.prepare_seconds = prepare.seconds();
    enter_preparation(meter.read());
    enter_camera(scene.camera);
    return true;
  }

  /// Cancelled before the first pixel.
  RenderResult no_frame() {
    picture_.clear_from(0);
    reports_.clear();
    RenderResult result;
    result.complete = false;
    RenderStatistics statistics = std::exchange(prepared_, nothing_prepared());
    collect(statistics, *machine_, frame_, reports_.all(), SpeMeter(*machine_).read());
    result.statistics = statistics;
    picture_.copy(picture_.rows(), image_, result);
    return result;
  }

  /// As prepare_scene(), at the cost of what has changed.
  bool prepare_changes(const Scene& scene, const SceneChanges& changes, const Progress& go_on) {
    if (!has_scene_ || stages_) return prepare_scene(scene, go_on);
    prepared_ = nothing_prepared();
    validate(scene.camera);
    const bool is_for_eye = image_.is_for(scene.camera.location);
    const Stopwatch build;
    retire_queries();
    const SceneChanges all = {changes.objects || !is_for_eye, changes.surfaces};
    if (!builder_->update_image(scene, all)) return prepare_scene(scene, go_on);
    keep_for_other_eyes(scene);
    media_ = media_of(scene);
    enter_scene(scene);
    prepared_.build_seconds = build.seconds();
    const Stopwatch prepare;
    const SpeMeter meter(*machine_);
    const std::optional<std::uint64_t> lines = builder_->update(all);
    if (!lines) return prepare_scene(scene, go_on);
    prepared_.stale_lines = *lines;
    prepared_.preparation =
        all.objects ? RenderStatistics::Preparation::refitted : RenderStatistics::Preparation::updated;
    prepared_.prepare_seconds = prepare.seconds();
    enter_preparation(meter.read());
    enter_camera(scene.camera);
    return true;
  }

  static RenderStatistics nothing_prepared() {
    RenderStatistics statistics;
    statistics.preparation = RenderStatistics::Preparation::kept;
    return statistics;
  }
  void enter_preparation(const std::vector<SpeStatistics>& spes) {
    prepared_.prepare_cycles = elapsed_cycles(spes);
    for (const SpeStatistics& spe : spes)
      prepared_.prepare += spe.cycles;
  }

  RenderResult render_camera(const Camera& camera, const Progress& progress) {
    if (!has_scene_ && !kept_) throw InputError("a camera alone cannot be rendered: there is no scene yet");
    check_room_for_all();
    if (!enter_moved_camera(camera) && !prepare_for_eye(moved_to(origin_, camera), progress))
      return no_frame();
    return render_frame(picture_.rows(), progress);
  }
  /// Takes another camera for the scene that is there. False, and nothing has changed, if there is none or
  /// its image is not for that camera.
  bool enter_moved_camera(const Camera& given) {
    validate(given);
    const Camera camera = moved_to(origin_, given);
    if (!has_scene_ || !image_.is_for(camera.location)) return false;
    prepared_ = nothing_prepared();
    enter_camera(camera);
    return true;
  }
  /// Makes the image of the kept scene for another camera. The scene is kept even if that is cancelled.
  bool prepare_for_eye(const Camera& camera, const Progress& progress) {
    is_edited_ = true; // Further cameras are likely to follow.
    const std::shared_ptr<Scene> scene = kept_;
    scene->camera = camera;
    const bool is_prepared = while_building(progress, [&](const Progress& go_on) {
      return prepare_changes(*scene, {false, false}, go_on);
    });
    if (!is_prepared) kept_ = scene;
    return is_prepared;
  }
  /// Keeps the scene of the image if cameras may come that the image is not for.
  void keep_for_other_eyes(const Scene& scene) {
    if (&scene == kept_.get()) return;
    kept_.reset();
    if (!is_last_frame_ && image_.depends_on_eye()) kept_ = std::make_shared<Scene>(scene);
  }
  /// Throws InputError if memory has no room for all rows.
  void check_room_for_all() const {
    if (options_.rows_at_once != 0 && picture_.rows().bottom > options_.rows_at_once)
      throw InputError("the picture has more rows than RenderOptions::rows_at_once: render_rows() is for it");
  }
  void enter_camera(const Camera& camera) {
    camera_ = camera;
    camera_limits_ = set_camera(frame_, camera, picture_on_grid(options_), media_, image_);
    plan_.forget_points();
  }

  /// What the frame block says of a scene whose image is there.
  void enter_scene(const Scene& scene) {
    set_scene(frame_, scene, options_, image_);
    // Each level of a tree adds what its surfaces push, but for the node that comes up next; straight
    // transmission may add some that cost no level. Averages of many mirrors push so much that there is a
    // limit: what passes it is dropped, and counted.
    constexpr std::uint32_t kMostBytesOfSpe = 8 << 20, kLevelsOfStraight = 32;
    const std::uint64_t levels = std::uint64_t{frame_.max_trace_level} + kLevelsOfStraight;
    const std::uint64_t wanted = levels * std::max(image_.header().surface_nodes, 2u) - levels;
    const auto most = std::max<std::uint64_t>(levels, kMostBytesOfSpe / kRayNodeBytes);
    // Where lights have areas or shadow rays go step by step, none of them stays in local store; where memory
    // is direct, none ever does.
    const bool has_resident = !machine_->direct_memory() && !has_areas(frame_) && !walks_shadows(frame_);
    const std::uint32_t nodes =
        static_cast<std::uint32_t>(std::min(wanted, most)) + (has_resident ? 0 : kResidentNodes);
    if (nodes == frame_.ray_stack_nodes) return;
    frame_.ray_stack_nodes = nodes;
    ray_stack_ = AlignedBlock::uninitialised(std::size_t{machine_->spe_count()} * nodes * kRayNodeBytes);
    frame_.ray_stack = to_ea(ray_stack_.data());
  }

  RenderResult render_frame(const RowRange& rows, const Progress& progress) {
    RenderStatistics statistics = std::exchange(prepared_, nothing_prepared());
    plan_.plan(rows);
    plan_.forget_points();
    // A frame that nobody can break off leaves no pixel out.
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
    statistics.limits = image_.limits();
    statistics.limits.insert(camera_limits_.begin(), camera_limits_.end());
    statistics.diagnostics = new_diagnostics();
    const ImageHeader& header = image_.header();
    statistics.bounds[0] = origin_ + Vec3(header.bounds_min[0], header.bounds_min[1], header.bounds_min[2]);
    statistics.bounds[1] = origin_ + Vec3(header.bounds_max[0], header.bounds_max[1], header.bounds_max[2]);
    result.statistics = statistics;
    // The picture then lies in memory that the scene has had. First hits ask where its tables are.
    if (is_last_frame_ && !options_.first_hits) image_ = SceneImage();
    picture_.copy(rows, image_, result);
    if (options_.work_map) result.work = std::move(work_);
    return result;
  }

  static Progress part_of(const Progress& progress, double begin, double end) {
    if (!progress) return progress;
    return [&progress, begin, end](double fraction) { return progress(begin + fraction * (end - begin)); };
  }

  /// A frame of the SPEs. False: `progress` broke it off. Adds to `reports`, by SPE.
  bool render_pass(WorkPlan& plan, const Progress& progress, std::span<ReportRecord> reports) {
    reports_.clear();
    ++frame_.epoch;
    plan.place(frame_);
    frame_.units_per_word = units_per_word(plan.units(), static_cast<bool>(progress));
    StripTally tally(machine_->spe_count(), plan.units());
    const BlockGrid blocks = picture_.blocks(bundle_edge(machine_->direct_memory()));
    std::vector<std::pair<std::uint32_t, unsigned>> done; // units, and by which SPE
    const auto unit_done = [&](std::uint32_t unit, unsigned spe) {
      done.emplace_back(unit, spe);
      if (options_.finished_block) picture_.tell_blocks(regions_of(plan.unit(unit), blocks), spe);
    };
    const Stopwatch pass;
    const bool complete =
        stages_ ? stages_->render_frame(progress) : team_->render_frame(tally, progress, unit_done);
    if (complete) report_pace().learn(plan.units(), pass.seconds());
    if (complete && stages_ && options_.finished_block) picture_.tell_blocks({region_of(options_)}, 0);
    work_ = work_of(plan, done, blocks);
    reports_.fetch();
    add(reports, reports_.all());
    if (complete && !stages_) plan.learn();
    return complete;
  }

  /// FrameBlock::units_per_word. Of emulated machines it does not depend on the host's time.
  std::uint32_t units_per_word(std::uint32_t units, bool is_asked) {
    if (options_.finished_block || options_.work_map) return kEachUnit;
    if (!machine_->direct_memory()) return units / 64 + 1;
    return is_asked ? report_pace().units_per_word(units) : 0;
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
  SceneImage image_;
  std::vector<Medium> media_;
  std::shared_ptr<RayQueryScene> query_scene_; ///< null: none of this scene was asked for
  bool has_scene_ = false;                     ///< and an accelerator for it
  Vec3 origin_ = Vec3(0); ///< of the image, in the scene's coordinates; the following are measured from it
  Camera camera_;         ///< of the next frame
  PassedLimits camera_limits_;
  std::shared_ptr<Scene> kept_; ///< that the image is of, where it depends on the eye
  RenderStatistics prepared_;   ///< what that took, for the statistics of the next frame
  // Everything from here to the machine is read and written by the SPEs.
  AlignedBlock ray_stack_; // the SPEs' own
  SharedRecords<ReportRecord> reports_;
  SharedRecords<FrameBlock> frame_block_;
  FrameBlock& frame_; ///< the PPE's
  PictureMemory picture_;
  FramePlan plan_;
  std::unique_ptr<Machine> machine_;
  std::unique_ptr<SpeTeam> team_;
  std::unique_ptr<AcceleratorBuilder> builder_;
  std::unique_ptr<StageTeam> stages_;
  ReportPace pace_, sample_pace_; ///< of passes by the plans
  double grid_share_ = 0.5;       ///< of the time of the last picture with antialiasing
  std::vector<WorkRecord> work_;  ///< of the last pass
  std::size_t known_diagnostics_ = 0;
  bool is_last_frame_ = false;
  bool is_edited_ = false; ///< scenes come with what has changed
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
