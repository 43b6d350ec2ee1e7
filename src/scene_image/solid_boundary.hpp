// Records of CSG's solids whose boundaries depend on where rays start.
#pragma once

#include "prepare/eye.hpp"
#include "records/csg.hpp"
#include "scene_image/shapes.hpp"

#include <cstdint>

namespace celltrace {

/// A solid whose record has the shape that with_boundary() returns.
struct SolidBoundary {
  std::uint32_t solid; ///< index in CsgParts::solids
  PlacedShape shape;   ///< shape before with_boundary()

  void write(const Eye& eye, kernel::SolidRecord* solids) const;
};

/// Writes the fields of a solid's record that come from its shape.
void write_shape(const PlacedShape& shape, kernel::SolidRecord& solid);

} // namespace celltrace
