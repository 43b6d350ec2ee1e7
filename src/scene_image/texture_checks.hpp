// What textures have to be before they become records.
#pragma once

#include "celltrace/scene.hpp"

#include <vector>

namespace celltrace {

/// Throws InputError, naming the material, unless all numbers are finite, maps have entries and neither nest
/// nor layer too deeply, and every pattern is one that there is.
void validate_textures(const std::vector<Material>& materials);

/// Likewise of the scene's sky sphere.
void validate_sky(const Scene& scene);

} // namespace celltrace
