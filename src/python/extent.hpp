// The extent of a scene's objects, for cameras that are to see all of them.
#pragma once

#include "celltrace/scene.hpp"

#include <vector>

namespace celltrace {

/// Returns points on or around the surfaces of all visible bounded objects; planes and inverse objects
/// are not bounded. The points of round shapes deviate a few percent of the size from the tangents.
std::vector<Vec3> points_around(const Scene& scene);

} // namespace celltrace
