// Checks of textures before they become records.
#pragma once

#include "celltrace/scene.hpp"

#include <vector>

namespace celltrace {

/// Throws InputError, naming the material, unless all numbers are finite, maps have entries and neither nest
/// nor layer too deeply, and every pattern has a known kind.
void validate_textures(const std::vector<Material>& materials);

/// Checks the textures of the scene's sky sphere in this way.
void validate_sky(const Scene& scene);

} // namespace celltrace
