// Tells whether translucent objects may be so close to each other that shadow rays miss some of their
// surfaces.
#pragma once

#include "celltrace/scene.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// Returns whether a ray may cross two translucent surfaces within POV-Ray's tolerance for shadows, 0.001
/// units: surfaces of two objects whose boxes are so close, or of one object that is so thin. The surfaces of
/// one mesh, or of one CSG that is no union, count as one. `material_flags` are the object flags of each
/// material.
bool has_near_surfaces(const Scene& scene, const std::vector<std::uint32_t>& material_flags);

} // namespace celltrace
