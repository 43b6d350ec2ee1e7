// Where a scene's objects are, for cameras that are to see all of them.
#pragma once

#include "celltrace/scene.hpp"

#include <vector>

namespace celltrace {

/// Points on or around the surfaces of all objects that are seen and end somewhere: planes and what is inside
/// out do not. Round shapes have points a few percent of their size from each other's tangents.
std::vector<Vec3> points_around(const Scene& scene);

} // namespace celltrace
