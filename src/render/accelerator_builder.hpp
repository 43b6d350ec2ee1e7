// Has the accelerator of a scene built, by the SPEs or on the PPE's side.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "kernel/records.hpp"
#include "render/spe_team.hpp"
#include "scene/scene_image.hpp"

namespace celltrace {

/// Keeps its work memory from frame to frame.
class AcceleratorBuilder {
public:
  /// All of them stay as long as this lives.
  AcceleratorBuilder(Machine& machine, SpeTeam& team, kernel::FrameBlock& frame, SceneImage& image)
      : machine_(machine), team_(team), frame_(frame), image_(image) {}

  /// Makes `image` that of `scene`. Throws as SceneImage::assign() does.
  void make_image(const Scene& scene);

  /// Makes room in the image and builds what the frame block asks for; then the frame block says where it
  /// lies. False if `go_on`, which hears the finished fraction now and then, has ended it: there is no
  /// accelerator then. What `go_on` throws passes through. Throws InputError if the image would pass 4 GB.
  bool build(const Progress& go_on);

private:
  bool build_grid();
  bool build_hierarchy(const Progress& go_on);
  bool build_hierarchy_on(SpeTeam& team, unsigned spes, const Progress& go_on);
  /// Tells the frame block where the image now lies, and work memory of `pairs` pairs in each of two blocks.
  void enter_memory(std::uint64_t pairs);
  const kernel::ReportRecord& report() const;

  Machine& machine_;
  SpeTeam& team_;
  kernel::FrameBlock& frame_;
  SceneImage& image_;
  AlignedBlock work_[2];
};

} // namespace celltrace
