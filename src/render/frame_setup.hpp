// From a Scene and options to the frame block that the SPEs read.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "kernel/records.hpp"
#include "scene_image/insides.hpp"
#include "scene_image/scene_image.hpp"

#include <vector>

namespace celltrace {

/// Pixels, size and limits: throws InputError for options out of range.
void check(const RenderOptions& options);

/// Fills what depends on the picture's size, the options and the machine.
void set_options(kernel::FrameBlock& frame, const RenderOptions& options, const Machine& machine);
/// Fills what depends on the scene but not on its camera.
void set_scene(kernel::FrameBlock& frame, const Scene& scene, const RenderOptions& options,
               const SceneImage& image);
/// Where a picture lies on the grid of points that its rays go through, which need not be all of it.
struct PictureOnGrid {
  double width, height;         ///< of the whole picture
  double left = 0.0, top = 0.0; ///< the middle of its upper left pixel: a column and a row of the grid
};
PictureOnGrid picture_on_grid(const RenderOptions& options);
/// `options` with what `given` says of pictures: their size and kind, and who hears of them.
RenderOptions with_picture_of(RenderOptions options, const RenderOptions& given);
/// Whether colours leave the SPEs as numbers.
bool brings_colours(const RenderOptions& options);
/// The part of the picture that is rendered.
PictureRegion region_of(const RenderOptions& options);
/// Returns the camera of rays through a picture, to which it adapts as Camera::framing says. Where there is
/// an image, rays of a camera that is far away from what it shows start just before that.
kernel::CameraRecord camera_record(const Camera& any_picture, const PictureOnGrid& picture,
                                   const SceneImage* image = nullptr);
/// Fills the camera, and the interiors of the media of the scene that it is inside of.
void set_camera(kernel::FrameBlock& frame, const Camera& camera, const PictureOnGrid& picture,
                const std::vector<Medium>& media, const SceneImage& image);
/// Chooses the grid's resolution for a number of objects in a box; offsets and counts stay 0.
kernel::GridRecord choose_grid(const kernel::ImageHeader& header);

} // namespace celltrace
