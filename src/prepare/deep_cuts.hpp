// Deepens holes that are cut only slightly deeper than the object around them, and thickens very thin plates.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>

namespace celltrace {

/// Moves faces of subtracted objects that lie just beyond a face of the CSG, as people place them so that a
/// hole is open, to a few millionths of their distance from the camera beyond it: in single precision both
/// faces would coincide, and the hole would be closed. Faces are those of boxes, cylinders and cones; CSGs
/// may also have planes. Plates as thin as this become that thick if they are in CSGs that show what is
/// inside of them: objects that lie on them would otherwise be inside only in places.
std::optional<Scene> deepen_cuts(const Scene& scene, const PassContext& context);

} // namespace celltrace
