// Bounds of a quadric within a box: CSG may bound a quadric that has no bounds of its own.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"

namespace celltrace {

/// Returns slightly enlarged bounds, within a box, of the inside of a quadric if `solid` is true, else of its
/// surface. The box and the result may be infinite (the greatest floats).
kernel::Aabb bounds_of_quadric(const Quadric& quadric, const Transform& transform, bool solid,
                               const kernel::Aabb& within);

} // namespace celltrace
