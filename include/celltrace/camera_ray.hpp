// The rays that pictures are traced along, for ray queries: what is under the mouse?
//
//   if (const auto ray = camera_ray(scene.camera, options.width, options.height, x + 0.5, y + 0.5))
//     const RayHit hit = queries.closest_hit(*ray);
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/ray.hpp"
#include "celltrace/scene.hpp"

#include <optional>

namespace celltrace {

/// The ray through a point of a picture of `width` times `height` pixels: `x` pixels from its left edge and
/// `y` from its upper one, so that the middle of the first pixel is at (0.5, 0.5). Its direction has length
/// 1. The same ray as the picture's, if that is not antialiased. Nothing where the camera sees nothing, as
/// outside the circle of a fisheye. Throws InputError for pictures without pixels. Safe to call from several
/// threads at once.
CELLTRACE_EXPORT std::optional<Ray> camera_ray(const Camera& camera, int width, int height, double x,
                                               double y);

} // namespace celltrace
