// A renderer's scene: made ready for a frame, from the beginning or at the cost of what has changed.
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

/// Returns what hears a part of the work's fraction as a share of all; `progress` has to live as long.
Progress part_of(const Progress& progress, double begin, double end);

/// The image of a scene, its accelerator and what the frame block says of both, for the camera of the next
/// frame. SPEs read them: it has to outlive the machine's programs.
class ScenePreparation {
public:
  /// All of them stay as long as this lives. `options` are as they are at each call.
  ScenePreparation(const RenderOptions& options, Machine& machine, kernel::FrameBlock& frame,
                   SharedRecords<kernel::ReportRecord>& reports, MachineDiagnostics& diagnostics)
      : options_(options), machine_(machine), frame_(frame), reports_(reports), diagnostics_(diagnostics) {}
  ~ScenePreparation() { retire_queries(); }
  ScenePreparation(const ScenePreparation&) = delete;
  ScenePreparation& operator=(const ScenePreparation&) = delete;

  /// Says which SPEs build accelerators, before anything else. `stages`: which have other programs; null:
  /// none do.
  void set_teams(SpeTeam& team, StageTeam* stages);
  /// No other frame follows the next one.
  void expect_last_frame() { is_last_frame_ = true; }

  /// Prepares a scene. False if `progress`, or RenderOptions::build_progress, has ended it: there is no scene
  /// then.
  bool prepare(const Scene& scene, const Progress& progress);
  /// Does so for a scene of which only `changes` are not as before.
  bool prepare(const Scene& scene, const SceneChanges& changes, const Progress& progress);
  /// Prepares the scene that was there for another camera. A scene that is kept is there even after this was
  /// ended.
  bool prepare(const Camera& camera, const Progress& progress);
  /// The options ask for another picture: the camera adapts to it.
  void follow_picture() {
    if (has_scene_) enter_camera(camera_);
  }

  bool has_scene() const { return has_scene_; }
  /// Returns whether there is one, or can be without being given again.
  bool knows_scene() const { return has_scene_ || kept_ != nullptr; }
  const SceneImage& image() const { return image_; }
  /// Gives the image's memory back; there is no scene then, nor was one kept.
  void release_image();
  RayQueries ray_queries();
  /// The scene will not be what they were made for.
  void retire_queries() noexcept;
  /// Returns what has been done since the last call, for the statistics of a frame.
  RenderStatistics take_statistics();
  /// Adds to a frame's statistics what they say of the scene.
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
  std::shared_ptr<RayQueryScene> query_scene_; ///< null: none of this scene was asked for
  bool has_scene_ = false;                     ///< and an accelerator for it
  Vec3 origin_ = Vec3(0); ///< of the image, in the scene's coordinates; the following are measured from it
  Camera camera_;         ///< of the next frame
  PassedLimits camera_limits_;
  std::shared_ptr<Scene> kept_; ///< that the image is of, where it depends on the eye
  RenderStatistics prepared_;   ///< what that took, for the statistics of the next frame
  AlignedBlock ray_stack_;      ///< the SPEs' own
  std::unique_ptr<AcceleratorBuilder> builder_;
  bool is_last_frame_ = false;
  bool is_edited_ = false; ///< scenes come with what has changed
};

} // namespace celltrace
