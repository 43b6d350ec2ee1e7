#include "scene_image/solid_boundary.hpp"

#include <algorithm>

namespace celltrace {

void SolidBoundary::write(const Eye& eye, kernel::SolidRecord* solids) const {
  write_shape(with_boundary(shape, eye), solids[solid]);
}

void write_shape(const PlacedShape& shape, kernel::SolidRecord& solid) {
  std::copy(shape.geometry, shape.geometry + 12, solid.object.geometry);
  std::copy(shape.parameters, shape.parameters + 2, solid.extra.value);
}

} // namespace celltrace
