// Has the accelerator of a scene built, by the SPEs or on the PPE's side.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "celltrace/spe/shared_records.hpp"
#include "render/bvh_refit.hpp"
#include "render/frame_fields.hpp"
#include "render/spe_team.hpp"
#include "scene_image/scene_image.hpp"
#include "scene_image/shared_image.hpp"

#include <cstdint>
#include <optional>

namespace celltrace {

/// Keeps its work memory from frame to frame.
class AcceleratorBuilder {
public:
  /// All of them stay as long as this lives. `reports` are what the frame block names.
  AcceleratorBuilder(Machine& machine, SpeTeam& team, kernel::FrameBlock& frame,
                     SharedRecords<kernel::ReportRecord>& reports, SceneImage& image)
      : machine_(machine), team_(team), frame_(frame), reports_(reports), image_(image),
        shared_image_(image, machine.byte_order()) {}

  /// Makes `image` that of `scene`; update_image() needs it to be updatable. Throws as SceneImage::assign()
  /// does.
  void make_image(const Scene& scene, const ImageMemory& memory);

  /// Makes room in the image and builds what the frame block asks for; then the frame block says where it
  /// lies. False if `go_on`, which hears the finished fraction now and then, has ended it: there is no
  /// accelerator then. What `go_on` throws passes through. Throws InputError if the image would pass 4 GB.
  bool build(const Progress& go_on);

  /// Makes `image` that of a scene in place, with the accelerator that build() left. False, and nothing has
  /// changed, if that cannot be done, or not well: it is all to be made anew. Throws as SceneImage::update().
  bool update_image(const Scene& scene, const SceneChanges& changes);
  /// Makes it that of the same scene with another camera. False, and nothing has changed, if that cannot be
  /// done without preparing all of it.
  bool update_boundaries(const Scene& scene);
  /// After that, and after the frame block has what it says of a scene: refits the BVH if objects changed,
  /// and lets the SPEs fetch again what they have to, of which this returns the number of lines. Nothing: the
  /// BVH would be so much worse than a new one that it has to be built.
  std::optional<std::uint64_t> update(const SceneChanges& changes);

private:
  unsigned host_threads() const;
  bool build_grid();
  bool build_bvh(const Progress& go_on);
  /// On the PPE's side.
  bool build_bvh_for_spes(const Progress& go_on);
  /// `frame` is the team's.
  bool build_bvh_on(SpeTeam& team, kernel::FrameBlock& frame, unsigned spes, const Progress& go_on);
  /// Tells the frame block where work memory of `pairs` pairs in each of two blocks lies.
  void enter_work_memory(std::uint64_t pairs);

  Machine& machine_;
  SpeTeam& team_;
  kernel::FrameBlock& frame_;
  SharedRecords<kernel::ReportRecord>& reports_;
  SceneImage& image_;
  SharedImage shared_image_;
  AlignedBlock work_[2];
  BvhRefit refit_;
};

} // namespace celltrace
