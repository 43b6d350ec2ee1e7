// Replaces spheres so large, compared with their distance, that single precision is not enough.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>

namespace celltrace {

/// Replaces such spheres, as of a planet under the camera, by quadrics about the point of their surface
/// nearest to the camera. Rays are then measured from a point that is near; measured from the centre, all
/// distances would lack as many digits as the radius has. Spheres stay if their materials read surface
/// coordinates, which a quadric has others of, if they are inverse or clipped, and beyond the first few.
std::optional<Scene> centre_large_spheres(const Scene& scene, const PassContext& context);

} // namespace celltrace
