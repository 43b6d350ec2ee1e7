// Fills the frame block, which the SPEs read, from a Scene and options.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "records/accelerator.hpp"
#include "records/frame.hpp"
#include "records/image.hpp"
#include "scene_image/scene_image.hpp"

namespace celltrace {

/// Sets the fields that depend on the picture's size, the options and the machine.
void set_options(kernel::FrameBlock& frame, const RenderOptions& options, const Machine& machine);
/// Sets the fields that depend on the scene but not on its camera.
void set_scene(kernel::FrameBlock& frame, const Scene& scene, const RenderOptions& options,
               const SceneImage& image);
/// Returns a grid with a resolution for a number of objects in a box; its offsets and counts stay 0.
kernel::GridRecord choose_grid(const kernel::ImageHeader& header);

} // namespace celltrace
