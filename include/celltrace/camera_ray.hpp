// Camera rays: the rays that pictures are traced along, for ray queries such as "what is under the mouse?"
//
//   if (const auto ray = camera_ray(scene.camera, options.width, options.height, x + 0.5, y + 0.5))
//     const RayHit hit = queries.closest_hit(*ray);
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/ray.hpp"
#include "celltrace/scene.hpp"

#include <optional>

namespace celltrace {

/// Returns the ray through a point of a picture of `width` times `height` pixels. `x` and `y` are in pixels
/// from the left and upper edges, so that the middle of the first pixel is (0.5, 0.5). The direction has
/// length 1. The picture's pixel is traced along the same ray if `x` and `y` are its middle, unless the
/// picture is antialiased. Returns nothing where the camera sees nothing, such as outside the circle of a
/// fisheye. Throws InputError if `width` or `height` is below 1. Safe to call from several threads at once.
CELLTRACE_EXPORT std::optional<Ray> camera_ray(const Camera& camera, int width, int height, double x,
                                               double y);

} // namespace celltrace
