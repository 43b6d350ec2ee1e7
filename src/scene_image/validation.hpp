// Parts of what validate() looks at.
#pragma once

#include "celltrace/scene.hpp"

namespace celltrace {

/// Throws InputError as validate() does; looks at nothing that is in Scene::objects.
void validate_all_but_objects(const Scene& scene);

} // namespace celltrace
