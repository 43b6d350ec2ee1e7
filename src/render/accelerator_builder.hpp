// Builds the accelerator of a scene, on the SPEs or on the host.
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

/// Builds accelerators; keeps its work memory from frame to frame.
class AcceleratorBuilder {
public:
  /// Refers to all arguments, which must outlive this object. `reports` are the reports that the frame block
  /// names.
  AcceleratorBuilder(Machine& machine, SpeTeam& team, kernel::FrameBlock& frame,
                     SharedRecords<kernel::ReportRecord>& reports, SceneImage& image)
      : machine_(machine), team_(team), frame_(frame), reports_(reports), image_(image),
        shared_image_(image, machine.byte_order()) {}

  /// Makes `image` the image of `scene`; update_image() needs an updatable image. Throws as
  /// SceneImage::assign() does.
  void make_image(const Scene& scene, const ImageMemory& memory);

  /// Reserves room in the image, builds the accelerator that the frame block asks for, and sets its place in
  /// the frame block. Returns false if `go_on`, which regularly gets the finished fraction, has ended the
  /// build; then there is no accelerator. Exceptions of `go_on` pass through. Throws InputError if the image
  /// would pass 4 GB.
  bool build(const Progress& go_on);

  /// Updates `image` in place for a scene, with the accelerator that build() left. Returns false if that is
  /// not possible; then everything has to be built anew. Throws as SceneImage::update() does.
  bool update_image(const Scene& scene, const SceneChanges& changes);
  /// Updates `image` for the same scene with another camera. Returns false, and changes nothing, if the whole
  /// scene would have to be prepared.
  bool update_boundaries(const Scene& scene);
  /// Completes update_image() or update_boundaries(), once the frame block describes the scene: refits the
  /// BVH if objects have changed, and makes the SPEs fetch changed cache lines again. Returns the number of
  /// these lines; nothing if the BVH has become so much worse than a new one that it has to be built anew.
  std::optional<std::uint64_t> update(const SceneChanges& changes);

private:
  unsigned host_threads() const;
  bool build_grid();
  bool build_bvh(const Progress& go_on);
  /// Builds the BVH on a native machine, for SPEs without direct memory.
  bool build_bvh_for_spes(const Progress& go_on);
  /// Builds the BVH on a team, whose frame block is `frame`.
  bool build_bvh_on(SpeTeam& team, kernel::FrameBlock& frame, unsigned spes, const Progress& go_on);
  /// Reserves work memory, `pairs` pairs in each of two blocks, and sets its place in the frame block.
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
