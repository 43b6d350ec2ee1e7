// The rays of POV-Ray's cameras in double precision.
#pragma once

#include "reference/geometry.hpp"

#include <optional>

namespace celltrace::reference {

/// The ray through a point of the picture, (0, 0) at the top left and (1, 1) at the bottom right; nothing
/// where the camera sees nothing.
std::optional<Ray> camera_ray(const Camera& camera, double x, double y);

} // namespace celltrace::reference
