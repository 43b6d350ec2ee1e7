// Decides which face is visible where faces of several objects lie in one plane.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>

namespace celltrace {

/// Moves overlapping faces of boxes and planes that lie in one plane apart, by a few millionths of their
/// distance from the camera, so that the face that POV-Ray shows is in front. In POV-Ray all these faces are
/// rounded alike, and the face that is tested first is visible (BoundingTree); single precision would show a
/// random mix. Boxes may be parts of a CSG: among the faces of one intersection, the last part's face is
/// visible. A face of a subtracted box, such as a room, is only moved if something transparent stands on it.
/// A cylinder or cone that stands there is placed behind the opaque face. Scenes of very many objects are not
/// changed.
std::optional<Scene> move_faces_apart(const Scene& scene, const PassContext& context);

} // namespace celltrace
