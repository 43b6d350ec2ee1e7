// What textures have to be before they become records.
#pragma once

#include "celltrace/scene.hpp"

#include <string>

namespace celltrace {

/// Throws InputError, with `name`, unless all numbers are finite, maps have entries and neither nest nor
/// layer too deeply, and every pattern is one that there is.
void validate_texture(const Material& material, const std::string& name);

/// Likewise of the scene's sky sphere.
void validate_sky(const Scene& scene);

} // namespace celltrace
