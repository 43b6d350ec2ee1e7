// What lights are projected through, beside the scene's own objects.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>

namespace celltrace {

/// Adds the projectors of a scene's lights to its objects, in the order of the lights, and their material
/// behind its materials. They have no meshes: triangles are polygons. It asks nothing of the context. Throws
/// InputError if a mesh is a part of a projector's CSG, or of what clips it.
std::optional<Scene> add_projectors(const Scene& scene, const PassContext& context);

} // namespace celltrace
