// The boxes around objects of a scene, CSGs among them.
#pragma once

#include "celltrace/scene.hpp"
#include "geometry/extent.hpp"

namespace celltrace {

/// POV-Ray's box around an object that is placed by `around`, everywhere around an inverse one. What clips it
/// does not count.
Extent extent_of(const Object& object, const Transform& around);

} // namespace celltrace
