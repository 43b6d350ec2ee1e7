// Checks of textures before they become records.
#pragma once

#include "celltrace/scene.hpp"

#include <vector>

namespace celltrace {

/// Throws InputError with the material's number unless all numbers are finite, all maps have entries, neither
/// maps nor layers nest too deeply, and every pattern has a known kind.
void validate_textures(const std::vector<Material>& materials);

/// Checks the pigments of the scene's sky sphere as validate_textures() checks materials.
void validate_sky(const Scene& scene);

} // namespace celltrace
