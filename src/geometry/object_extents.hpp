// Boxes around objects of a scene, including CSGs.
#pragma once

#include "celltrace/scene.hpp"
#include "geometry/extent.hpp"

namespace celltrace {

/// Returns POV-Ray's box around an object that is placed by `around`; infinite if the object is inverse.
/// Objects that clip it are ignored.
Extent extent_of(const Object& object, const Transform& around);

} // namespace celltrace
