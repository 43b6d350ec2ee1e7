// Handles cameras so far from the scene that single precision has no digits left for it.
#pragma once

#include "celltrace/scene.hpp"
#include "scene_image/scene_image.hpp"

namespace celltrace {

/// Returns how far ahead of the camera its rays may start, in lengths of its direction, or of the unit vector
/// along the direction if the camera's kind ignores its length: no ray of the picture hits anything before
/// that distance. Returns 0 if rays should start at the camera, because it is near the scene or sees a large
/// part of it. `margin` is how much wider than the camera's view the picture may be, as a share of the view.
/// Adds limits that the scene passes to `limits` unless `limits` is null.
double start_of_rays(const Camera& camera, double margin, const SceneImage& image, PassedLimits* limits);

} // namespace celltrace
