// Faces of several objects in one plane: which one is seen.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>

namespace celltrace {

/// Moves faces of boxes and planes that lie in one plane, and overlap, apart, by a few millionths of their
/// distance from the camera, so that the one is in front that POV-Ray shows. There rounding is the same for
/// all of them and the first one counts that is tested (BoundingTree); single precision would show now the
/// one and now the other. Boxes may be parts of a CSG: of faces of one intersection that of the last part is
/// seen. Of boxes that are cut out, as rooms are, only what transparent things stand on is moved. Where such
/// a thing is a cylinder or cone, it stands behind what is opaque. Scenes of very many objects stay as they
/// are.
std::optional<Scene> move_faces_apart(const Scene& scene, const PassContext& context);

} // namespace celltrace
