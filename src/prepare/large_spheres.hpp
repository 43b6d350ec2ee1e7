// Replaces spheres that are so large, compared with their distance, that single precision is not enough.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>

namespace celltrace {

/// Replaces such spheres, for example a planet under the camera, by quadrics about the point of their surface
/// nearest to the camera. Rays are then measured from a near point; measured from the centre, distances would
/// lose as many digits as the radius has. Spheres stay if they are inverse or clipped, if they come after the
/// first few, or if their materials read surface coordinates, in which a quadric differs.
std::optional<Scene> centre_large_spheres(const Scene& scene, const PassContext& context);

} // namespace celltrace
