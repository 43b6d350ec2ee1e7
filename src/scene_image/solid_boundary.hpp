// Boundaries of the solids of CSG, which depend on where rays start.
#pragma once

#include "prepare/eye.hpp"
#include "records/csg.hpp"
#include "scene_image/shapes.hpp"

#include <cstdint>

namespace celltrace {

/// A solid whose record describes its shape after with_boundary().
struct SolidBoundary {
  std::uint32_t solid; ///< index among the solids
  PlacedShape shape;   ///< without the boundary

  void write(const Eye& eye, kernel::SolidRecord* solids) const;
};

/// Writes the fields of a solid's record that come from its shape.
void write_shape(const PlacedShape& shape, kernel::SolidRecord& solid);

} // namespace celltrace
