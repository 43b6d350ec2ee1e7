#include "geometry/object_extents.hpp"

#include "geometry/shape_geometry.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <variant>

namespace celltrace {

namespace {

bool is_finite(const Extent& extent) {
  bool result = true;
  for (int axis = 0; axis < 3; ++axis)
    result = result && std::isfinite(extent.min[axis]) && std::isfinite(extent.max[axis]);
  return result;
}

Extent extent_of(const Csg& csg) {
  const bool is_limited =
      csg.operation == Csg::Operation::intersection || csg.operation == Csg::Operation::difference;
  std::optional<Extent> all;
  for (std::size_t i = 0; i < csg.parts.size(); ++i) {
    const Object& part = csg.parts[i];
    const bool is_inverse = part.inverse != (csg.operation == Csg::Operation::difference && i > 0);
    const auto* const plane = std::get_if<Plane>(&part.shape);
    Extent extent;
    if (is_limited && plane != nullptr) {
      extent = geometry::half_space(*plane, part.transform, is_inverse);
      if (!is_finite(extent))
        continue; // skips objects with a singular transformation, which are rejected elsewhere
    } else if (is_limited && is_inverse) {
      continue;
    } else {
      extent = extent_of(part, Transform());
    }
    if (!all)
      all = extent;
    else
      all = is_limited ? all->common(extent) : all->joined(extent);
  }
  return all.value_or(Extent::everywhere());
}

} // namespace

Extent extent_of(const Object& object, const Transform& around) {
  if (object.inverse) return Extent::everywhere();
  const Transform transform = object.transform.then(around);
  const auto* const csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  // POV-Ray transforms a CSG's box, which may become larger than the box around the transformed parts.
  return csg != nullptr ? extent_of(**csg).moved(transform) : geometry::extent_of(object.shape, transform);
}

} // namespace celltrace
