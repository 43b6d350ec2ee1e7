// Makes the record from which rays are generated, of a Camera and a picture.
#pragma once

#include "celltrace/render.hpp"
#include "records/camera.hpp"
#include "records/frame.hpp"
#include "scene_image/insides.hpp"
#include "scene_image/scene_image.hpp"

#include <vector>

namespace celltrace {

/// The place of a picture on the grid of points that its rays go through, which may be a part of the grid.
struct PictureOnGrid {
  double width, height; ///< size of the whole picture
  double left = 0.0,
         top = 0.0; ///< column and row of the grid for the middle of the picture's upper left pixel
};
PictureOnGrid picture_on_grid(const RenderOptions& options);
/// Returns the record of a camera for a picture, to which the camera adapts as Camera::framing says. If there
/// is an image, rays of a camera that is far away from the scene start just before it. Adds limits that the
/// scene passes to `limits` unless that is null.
kernel::CameraRecord camera_record(const Camera& any_picture, const PictureOnGrid& picture,
                                   const SceneImage* image = nullptr, PassedLimits* limits = nullptr);
/// Sets the camera in the frame block, and the interiors of the media that it is inside of. Returns the
/// limits that the scene passes.
PassedLimits set_camera(kernel::FrameBlock& frame, const Camera& camera, const PictureOnGrid& picture,
                        const std::vector<Medium>& media, const SceneImage& image);

} // namespace celltrace
