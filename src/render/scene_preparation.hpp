// Prepares a renderer's scene for a frame, from scratch or at the cost of the changes.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "celltrace/spe/shared_records.hpp"
#include "memory/aligned_block.hpp"
#include "render/accelerator_builder.hpp"
#include "render/frame_fields.hpp"
#include "render/machine_diagnostics.hpp"
#include "render/models/stage_team.hpp"
#include "render/ray_query_scene.hpp"
#include "render/spe_team.hpp"
#include "scene_image/insides.hpp"
#include "scene_image/scene_image.hpp"

#include <memory>
#include <vector>

namespace celltrace {

/// Returns a function that reports a fraction of one part of the work as a fraction of the whole; `progress`
/// must outlive it.
Progress part_of(const Progress& progress, double begin, double end);

/// The image of a scene, its accelerator and the description of both in the frame block, for the camera of
/// the next frame. SPEs read them, so that this object must outlive the machine's programs.
class ScenePreparation {
public:
  /// Refers to all arguments, which must outlive this object. Each call uses the current `options`.
  ScenePreparation(const RenderOptions& options, Machine& machine, kernel::FrameBlock& frame,
                   SharedRecords<kernel::ReportRecord>& reports, MachineDiagnostics& diagnostics)
      : options_(options), machine_(machine), frame_(frame), reports_(reports), diagnostics_(diagnostics) {}
  ~ScenePreparation() { retire_queries(); }
  ScenePreparation(const ScenePreparation&) = delete;
  ScenePreparation& operator=(const ScenePreparation&) = delete;

  /// Sets the SPEs that build accelerators; call it before any other function. `stages` are SPEs that run
  /// other programs; null if there are none.
  void set_teams(SpeTeam& team, StageTeam* stages);
  /// Tells this object that the next frame is the last one.
  void expect_last_frame() { is_last_frame_ = true; }

  /// Prepares a scene. Returns false if `progress`, or RenderOptions::build_progress, has ended the
  /// preparation; then there is no scene.
  bool prepare(const Scene& scene, const Progress& progress);
  /// Prepares a scene that differs from the last one in `changes` only.
  bool prepare(const Scene& scene, const SceneChanges& changes, const Progress& progress);
  /// Prepares the current scene for another camera. A kept scene stays available even if `progress` ends the
  /// preparation.
  bool prepare(const Camera& camera, const Progress& progress);
  /// Adapts the camera to another picture in the options.
  void follow_picture() {
    if (has_scene_) enter_camera(camera_);
  }

  bool has_scene() const { return has_scene_; }
  /// Returns whether there is a prepared scene, or a kept scene that can be prepared again.
  bool knows_scene() const { return has_scene_ || kept_ != nullptr; }
  const SceneImage& image() const { return image_; }
  /// Frees the image's memory; then there is no scene, not even a kept one.
  void release_image();
  RayQueries ray_queries();
  /// Retires the ray queries, since their scene is about to be replaced.
  void retire_queries() noexcept;
  /// Returns the work since the last call, for the statistics of a frame.
  RenderStatistics take_statistics();
  /// Adds the image and the accelerator to a frame's statistics.
  void describe(RenderStatistics& statistics) const;

private:
  template <class Work> bool while_wanted(const Progress& progress, const Scene& scene, Work work);
  template <class Work> bool while_building(const Progress& progress, Work work);
  void forget_scene();
  bool prepare_scene(const Scene& scene, const Progress& go_on);
  bool prepare_changes(const Scene& scene, const SceneChanges& changes, const Progress& go_on);
  void enter_preparation(const std::vector<SpeStatistics>& spes);
  bool enter_moved_camera(const Camera& given);
  bool prepare_for_eye(const Camera& camera, const Progress& progress);
  void keep_for_other_eyes(const Scene& scene);
  void enter_camera(const Camera& camera);
  void enter_scene(const Scene& scene);

  const RenderOptions& options_;
  Machine& machine_;
  kernel::FrameBlock& frame_;
  SharedRecords<kernel::ReportRecord>& reports_;
  MachineDiagnostics& diagnostics_;
  SpeTeam* team_ = nullptr;
  StageTeam* stages_ = nullptr;
  SceneImage image_;
  std::vector<Medium> media_;
  std::shared_ptr<RayQueryScene> query_scene_; ///< null if no queries of this scene were requested
  bool has_scene_ = false;                     ///< true if there is a scene with an accelerator
  Vec3 origin_ =
      Vec3(0); ///< origin of the image, in the scene's coordinates, to which the members below are relative
  Camera camera_; ///< camera of the next frame
  PassedLimits camera_limits_;
  std::shared_ptr<Scene> kept_; ///< scene of the image, kept if the image depends on the eye
  RenderStatistics prepared_;   ///< cost of preparation, for the statistics of the next frame
  AlignedBlock ray_stack_;      ///< memory for the ray stacks of all SPEs
  std::unique_ptr<AcceleratorBuilder> builder_;
  bool is_last_frame_ = false;
  bool is_edited_ = false; ///< true if later scenes come with a list of changes
};

} // namespace celltrace
