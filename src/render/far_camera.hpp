// Cameras so far from what they see that single precision has no digits left for what is before them.
#pragma once

#include "celltrace/scene.hpp"
#include "scene_image/scene_image.hpp"

namespace celltrace {

/// Returns how far ahead of the camera its rays may start, in lengths of its direction, or of the unit vector
/// along it where the kind takes no other: no ray of the picture meets anything before that. 0 if they should
/// start at the camera: it is near, or sees so much that nothing near to it is small. `margin` is how much
/// wider than the camera's view the picture may be, as a share of it. `limits` get what it passes, unless
/// they are null.
double start_of_rays(const Camera& camera, double margin, const SceneImage& image, PassedLimits* limits);

} // namespace celltrace
