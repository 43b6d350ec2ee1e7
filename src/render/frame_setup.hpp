// From a Scene and options to the frame block that the SPEs read.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "kernel/records.hpp"
#include "scene/scene_image.hpp"

#include <vector>

namespace celltrace {

/// Pixels, size and limits: throws InputError for options out of range.
void check(const RenderOptions& options);

/// Fills what depends on the picture's size, the options and the machine.
void set_options(kernel::FrameBlock& frame, const RenderOptions& options, const Machine& machine);
/// Fills what depends on the scene but not on its camera.
void set_scene(kernel::FrameBlock& frame, const Scene& scene, const RenderOptions& options,
               const SceneImage& image);
/// A sphere of a scene that a camera may be in, and the interior that rays then begin in.
struct Medium {
  Sphere sphere;
  Transform transform;
  Index interior;
};
/// All of a scene's; none where no material asks what a ray is in.
std::vector<Medium> media_of(const Scene& scene);
/// Fills the camera, and the interiors of the media of the scene that it is inside of.
void set_camera(kernel::FrameBlock& frame, const Camera& camera, const std::vector<Medium>& media,
                const SceneImage& image);
/// Chooses the grid's resolution for a number of objects in a box; offsets and counts stay 0.
kernel::GridRecord choose_grid(const kernel::ImageHeader& header);

} // namespace celltrace
