// Parts of validate().
#pragma once

#include "celltrace/scene.hpp"

namespace celltrace {

/// Throws InputError as validate() does, but does not check Scene::objects.
void validate_all_but_objects(const Scene& scene);

} // namespace celltrace
