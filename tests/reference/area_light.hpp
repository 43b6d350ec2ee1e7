// Soft shadows as POV-Ray samples them, in double precision.
#pragma once

#include "celltrace/scene.hpp"

#include <functional>

namespace celltrace::reference {

/// From the middle of a light to one of its places; `toward` is the unit vector from the surface to the
/// middle. Without jitter.
Vec3 area_offset(const LightArea& area, const Vec3& toward, int column, int row);

/// What comes from all of it. `from_place(column, row)` is what comes from one place; it may be asked again.
Vec3 area_mean(const LightArea& area, const std::function<Vec3(int, int)>& from_place);

} // namespace celltrace::reference
