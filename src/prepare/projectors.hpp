// Adds the objects that lights are projected through to the scene's own objects.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>

namespace celltrace {

/// Adds the projectors of a scene's lights to the scene's objects, in the order of the lights, and their
/// material behind the scene's materials. Triangles of their meshes become polygons. Does not use the
/// context. Throws InputError if a mesh is part of a projector's CSG or clips a projector.
std::optional<Scene> add_projectors(const Scene& scene, const PassContext& context);

} // namespace celltrace
