#include "render/scene_preparation.hpp"

#include "celltrace/error.hpp"
#include "kernel/shading/ray_stack.hpp"
#include "prepare/scene_origin.hpp"
#include "render/camera_setup.hpp"
#include "render/frame_setup.hpp"
#include "render/quality.hpp"
#include "render/statistics.hpp"
#include "render/stopwatch.hpp"
#include "scene/progress_monitor.hpp"

#include <algorithm>
#include <utility>

namespace celltrace {

using namespace kernel;

namespace {

/// The share of build progress that is spent on the scene image.
constexpr double kImageShare = 0.2;

RenderStatistics nothing_prepared() {
  RenderStatistics statistics;
  statistics.preparation = RenderStatistics::Preparation::kept;
  return statistics;
}

} // namespace

Progress part_of(const Progress& progress, double begin, double end) {
  if (!progress) return progress;
  return [&progress, begin, end](double fraction) { return progress(begin + fraction * (end - begin)); };
}

void ScenePreparation::set_teams(SpeTeam& team, StageTeam* stages) {
  team_ = &team;
  stages_ = stages;
  builder_ = std::make_unique<AcceleratorBuilder>(machine_, team, frame_, reports_, image_);
}

bool ScenePreparation::prepare(const Scene& scene, const Progress& progress) {
  return while_wanted(progress, scene, [&](const Scene& wanted, const Progress& go_on) {
    return prepare_scene(wanted, go_on);
  });
}

bool ScenePreparation::prepare(const Scene& scene, const SceneChanges& changes, const Progress& progress) {
  is_edited_ = true;
  if (!changes.objects && !changes.surfaces && enter_moved_camera(scene.camera)) return true;
  return while_wanted(progress, scene, [&](const Scene& wanted, const Progress& go_on) {
    return prepare_changes(wanted, changes, go_on);
  });
}

bool ScenePreparation::prepare(const Camera& camera, const Progress& progress) {
  return enter_moved_camera(camera) || prepare_for_eye(moved_to(origin_, camera), progress);
}

void ScenePreparation::release_image() {
  image_ = SceneImage();
}

RayQueries ScenePreparation::ray_queries() {
  if (!has_scene_) throw InputError("ray queries need a scene: none is prepared");
  if (static_cast<AcceleratorKind>(frame_.accelerator) != AcceleratorKind::bvh)
    throw InputError("ray queries need a BVH: the scene's accelerator is a grid");
  if (!query_scene_)
    query_scene_ = std::make_shared<RayQueryScene>(
        frame_, image_, origin_, machine_.direct_memory() ? machine_.spu_key() : make_machine({})->spu_key());
  return RayQueryScene::queries(query_scene_);
}

RenderStatistics ScenePreparation::take_statistics() {
  return std::exchange(prepared_, nothing_prepared());
}

void ScenePreparation::describe(RenderStatistics& statistics) const {
  statistics.limits = image_.limits();
  statistics.limits.insert(camera_limits_.begin(), camera_limits_.end());
  const ImageHeader& header = image_.header();
  statistics.bounds[0] = origin_ + Vec3(header.bounds_min[0], header.bounds_min[1], header.bounds_min[2]);
  statistics.bounds[1] = origin_ + Vec3(header.bounds_max[0], header.bounds_max[1], header.bounds_max[2]);
}

void ScenePreparation::retire_queries() noexcept {
  if (query_scene_) query_scene_->retire();
  query_scene_.reset();
}

/// Calls work(scene, go_on), where `scene` is reduced to the picture's quality and moved to its origin, and
/// `go_on` reports progress. Returns false if the caller has ended the work; then there is no scene.
template <class Work>
bool ScenePreparation::while_wanted(const Progress& progress, const Scene& scene, Work work) {
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

/// Calls work(go_on) with the same `go_on` and result as while_wanted().
template <class Work> bool ScenePreparation::while_building(const Progress& progress, Work work) {
  Progress go_on;
  if (options_.build_progress || progress)
    go_on = [&, reached = 0.0](double fraction) mutable {
      reached = std::max(reached, fraction); // whichever thread reports it
      return (!options_.build_progress || options_.build_progress(reached)) && (!progress || progress(0));
    };
  const Progress of_image = part_of(go_on, 0, kImageShare);
  const ProgressMonitor monitor(of_image);
  try {
    const bool is_built =
        diagnostics_.reporting_failures([&] { return work(part_of(go_on, kImageShare, 1)); });
    if (!is_built) forget_scene();
    return is_built;
  } catch (const Cancelled&) {
    forget_scene();
    return false;
  } catch (...) {
    if (monitor.has_stopped()) forget_scene();
    throw;
  }
}

void ScenePreparation::forget_scene() {
  has_scene_ = false;
  kept_.reset();
}

/// Builds the image and the accelerator. Returns false if `go_on` cancelled the build.
bool ScenePreparation::prepare_scene(const Scene& scene, const Progress& go_on) {
  prepared_ = RenderStatistics();
  const Stopwatch build;
  retire_queries();
  builder_->make_image(scene, {is_edited_, options_.ray_queries, !is_last_frame_, options_.most_memory});
  keep_for_other_eyes(scene);
  has_scene_ = false;
  media_ = media_of(scene);
  prepared_.build_seconds = build.seconds();
  const Stopwatch prepare;
  const SpeMeter meter(machine_);
  enter_scene(scene);
  team_->assemble();
  if (!builder_->build(go_on)) return false;
  if (stages_) team_->dismiss(); // so that the SPEs can run other programs
  has_scene_ = true;
  prepared_.prepare_seconds = prepare.seconds();
  enter_preparation(meter.read());
  enter_camera(scene.camera);
  return true;
}

/// Prepares the scene with the result of prepare_scene(), but does only the work that the changes require.
bool ScenePreparation::prepare_changes(const Scene& scene, const SceneChanges& changes,
                                       const Progress& go_on) {
  if (!has_scene_ || stages_) return prepare_scene(scene, go_on);
  prepared_ = nothing_prepared();
  validate(scene.camera);
  const bool is_for_eye = image_.is_for(scene.camera.location);
  const Stopwatch build;
  retire_queries();
  SceneChanges all = {changes.objects || !is_for_eye, changes.surfaces};
  if (!changes.objects && !changes.surfaces && kept_ != nullptr && builder_->update_boundaries(scene)) {
    all = {false, false};
    kept_->camera = scene.camera;
  } else {
    if (!builder_->update_image(scene, all)) {
      has_scene_ = false; // the image may have been changed in part
      return prepare_scene(scene, go_on);
    }
    keep_for_other_eyes(scene);
    media_ = media_of(scene);
  }
  enter_scene(scene);
  prepared_.build_seconds = build.seconds();
  const Stopwatch prepare;
  const SpeMeter meter(machine_);
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

void ScenePreparation::enter_preparation(const std::vector<SpeStatistics>& spes) {
  prepared_.prepare_cycles = elapsed_cycles(spes);
  for (const SpeStatistics& spe : spes)
    prepared_.prepare += spe.cycles;
}

/// Sets another camera for the current scene. Returns false, and changes nothing, if there is no scene, or if
/// its image is not for that camera.
bool ScenePreparation::enter_moved_camera(const Camera& given) {
  validate(given);
  const Camera camera = moved_to(origin_, given);
  if (!has_scene_ || !image_.is_for(camera.location)) return false;
  prepared_ = nothing_prepared();
  enter_camera(camera);
  return true;
}

/// Builds the image of the kept scene for another camera. Keeps the scene even if `progress` ends the build.
bool ScenePreparation::prepare_for_eye(const Camera& camera, const Progress& progress) {
  is_edited_ = true; // further cameras are likely to follow
  const std::shared_ptr<Scene> scene = kept_;
  scene->camera = camera;
  const bool is_prepared = while_building(progress, [&](const Progress& go_on) {
    return prepare_changes(*scene, {false, false}, go_on);
  });
  if (!is_prepared) kept_ = scene;
  return is_prepared;
}

/// Keeps the scene of the image if later cameras may need another image.
void ScenePreparation::keep_for_other_eyes(const Scene& scene) {
  if (&scene == kept_.get()) return;
  kept_.reset();
  if (!is_last_frame_ && image_.depends_on_eye()) kept_ = std::make_shared<Scene>(scene);
}

void ScenePreparation::enter_camera(const Camera& camera) {
  camera_ = camera;
  camera_limits_ = set_camera(frame_, camera, picture_on_grid(options_), media_, image_);
}

/// Describes a scene in the frame block; the scene's image must be complete.
void ScenePreparation::enter_scene(const Scene& scene) {
  set_scene(frame_, scene, options_, image_);
  // Each level of a ray tree adds the nodes that its surfaces push, except the node that is processed next;
  // straight transmission may add some without a level. Averages of many mirrors push so many that the stack
  // has a limit: further nodes are dropped, and counted.
  constexpr std::uint32_t kMostBytesOfSpe = 8 << 20, kLevelsOfStraight = 32;
  const std::uint64_t levels = std::uint64_t{frame_.max_trace_level} + kLevelsOfStraight;
  const std::uint64_t wanted = levels * std::max(image_.header().surface_nodes, 2u) - levels;
  const auto most = std::max<std::uint64_t>(levels, kMostBytesOfSpe / kRayNodeBytes);
  // No node stays in local store if lights have areas, if shadow rays go step by step, or with direct memory.
  const bool has_resident = !machine_.direct_memory() && !has_areas(frame_) && !walks_shadows(frame_);
  const std::uint32_t nodes =
      static_cast<std::uint32_t>(std::min(wanted, most)) + (has_resident ? 0 : kResidentNodes);
  if (nodes == frame_.ray_stack_nodes) return;
  frame_.ray_stack_nodes = nodes;
  ray_stack_ = AlignedBlock::uninitialised(std::size_t{machine_.spe_count()} * nodes * kRayNodeBytes);
  frame_.ray_stack = to_ea(ray_stack_.data());
}

} // namespace celltrace
