// Deepens holes whose cuts end just beyond the object around them, and thickens very thin plates.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>

namespace celltrace {

/// Moves faces of subtracted objects that lie just beyond a face of the CSG, as people place them so that a
/// hole is open, to a few millionths of their distance from the camera beyond that face. In single precision
/// both faces would coincide, and the hole would be closed. Moved faces are those of boxes, cylinders and
/// cones; the CSG's faces may also be planes. Plates that are thinner than this become that thick if they
/// belong to CSGs that show only what is inside of other parts: objects on such a plate would otherwise be
/// inside of it only in places.
std::optional<Scene> deepen_cuts(const Scene& scene, const PassContext& context);

} // namespace celltrace
