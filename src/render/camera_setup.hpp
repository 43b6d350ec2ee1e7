// From a Camera and a picture to the record that rays are made by.
#pragma once

#include "celltrace/render.hpp"
#include "records/camera.hpp"
#include "records/frame.hpp"
#include "scene_image/insides.hpp"
#include "scene_image/scene_image.hpp"

#include <vector>

namespace celltrace {

/// Where a picture lies on the grid of points that its rays go through, which need not be all of it.
struct PictureOnGrid {
  double width, height;         ///< of the whole picture
  double left = 0.0, top = 0.0; ///< the middle of its upper left pixel: a column and a row of the grid
};
PictureOnGrid picture_on_grid(const RenderOptions& options);
/// Returns the camera of rays through a picture, to which it adapts as Camera::framing says. Where there is
/// an image, rays of a camera that is far away from what it shows start just before that; `limits` get what
/// it passes, unless they are null.
kernel::CameraRecord camera_record(const Camera& any_picture, const PictureOnGrid& picture,
                                   const SceneImage* image = nullptr, PassedLimits* limits = nullptr);
/// Fills the camera, and the interiors of the media of the scene that it is inside of. Returns the limits
/// that it passes.
PassedLimits set_camera(kernel::FrameBlock& frame, const Camera& camera, const PictureOnGrid& picture,
                        const std::vector<Medium>& media, const SceneImage& image);

} // namespace celltrace
