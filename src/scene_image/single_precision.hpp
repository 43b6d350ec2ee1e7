// Which objects single precision has numbers for.
#pragma once

#include "geometry/shape_geometry.hpp"

namespace celltrace::geometry {

/// Whether rays can be tested against a shape, no CSG, in single precision: it is not too large, too thin or
/// too far away. The transformation is not singular.
bool fits_single_precision(const Shape& shape, const Transform& transform);

} // namespace celltrace::geometry
