// Spheres that are so large beside their distance that single precision would not do.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>

namespace celltrace {

/// Makes quadrics of such spheres, planets under a camera's feet, about the point of their surface that is
/// nearest to the camera. What rays are measured from is near then; from the middle of a sphere the digits of
/// its radius would be missing from all distances. Spheres whose materials ask for surface coordinates stay
/// as they are, as a quadric has others; inverse and clipped ones do, too, and those behind the first few.
std::optional<Scene> centre_large_spheres(const Scene& scene, const PassContext& context);

} // namespace celltrace
