// How far a quadric reaches within a box: what CSG leaves of one has bounds where it has none by itself.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"

namespace celltrace {

/// Around what is inside of a quadric, if `solid`, or else of its surface, within a box, and a little more.
/// The box and the result may reach to infinity, as the greatest floats.
kernel::Aabb bounds_of_quadric(const Quadric& quadric, const Transform& transform, bool solid,
                               const kernel::Aabb& within);

} // namespace celltrace
