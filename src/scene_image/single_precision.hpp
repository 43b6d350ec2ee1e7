// Tells which objects single precision can represent.
#pragma once

#include "geometry/shape_geometry.hpp"

namespace celltrace::geometry {

/// Returns whether rays can be tested against a shape, which is no CSG, in single precision: it is not too
/// large, too thin or too far away. The transformation must not be singular.
bool fits_single_precision(const Shape& shape, const Transform& transform);

} // namespace celltrace::geometry
