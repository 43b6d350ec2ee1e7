// Whether translucent objects may be so near each other that shadow rays do not see all of their surfaces.
#pragma once

#include "celltrace/scene.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// Whether a ray may cross two translucent surfaces within POV-Ray's tolerance for shadows, 0.001: those of
/// two objects whose boxes are so near each other, or of one that is so thin. Surfaces of one mesh and of one
/// CSG that is no union count as one. `material_flags`: the flags of objects that consist of a material.
bool has_near_surfaces(const Scene& scene, const std::vector<std::uint32_t>& material_flags);

} // namespace celltrace
