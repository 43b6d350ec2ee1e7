// Holes that are cut only a little deeper than what they are cut out of, and plates that are hardly thick.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>

namespace celltrace {

/// Moves the faces of what is cut out of a CSG that lie just beyond one of its faces, as people put them so
/// that a hole is open, a few millionths of their distance from the camera beyond it: in single precision the
/// two would else be one, and the hole closed. Faces are those of boxes, cylinders and cones; CSGs may also
/// have planes. Plates that are as thin, of CSGs that show what is inside of them, become that thick: what
/// lies on them would else be inside of them only here and there.
std::optional<Scene> deepen_cuts(const Scene& scene, const PassContext& context);

} // namespace celltrace
