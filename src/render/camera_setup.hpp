// Makes the record from which the kernel generates rays, from a Camera and a picture's place on the grid.
#pragma once

#include "celltrace/render.hpp"
#include "records/camera.hpp"
#include "records/frame.hpp"
#include "scene_image/insides.hpp"
#include "scene_image/scene_image.hpp"

#include <vector>

namespace celltrace {

/// The place of a picture on the grid of points through which its rays go. The picture may be a part of the
/// grid.
struct PictureOnGrid {
  double width, height; ///< size of the whole picture
  double left = 0.0,
         top = 0.0; ///< column and row of the grid for the middle of the picture's upper left pixel
};
PictureOnGrid picture_on_grid(const RenderOptions& options);
/// Returns the record of a camera for a picture, to which the camera adapts as Camera::framing says. If
/// `image` is not null, rays of a camera far away from the scene start just before the scene. Adds limits
/// that the scene passes to `limits` unless `limits` is null.
kernel::CameraRecord camera_record(const Camera& any_picture, const PictureOnGrid& picture,
                                   const SceneImage* image = nullptr, PassedLimits* limits = nullptr);
/// Sets the camera in the frame block, and the interiors of the media that contain the camera. Returns the
/// limits that the scene passes.
PassedLimits set_camera(kernel::FrameBlock& frame, const Camera& camera, const PictureOnGrid& picture,
                        const std::vector<Medium>& media, const SceneImage& image);

} // namespace celltrace
