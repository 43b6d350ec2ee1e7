#include "scene/object_extents.hpp"

#include "scene/shape_geometry.hpp"

#include <memory>
#include <variant>

namespace celltrace {

Extent extent_of(const Object& object, const Transform& around) {
  if (object.inverse) return Extent::everywhere();
  const Transform transform = object.transform.then(around);
  const auto* const csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  if (csg == nullptr) return geometry::extent_of(object.shape, transform);
  const std::vector<Object>& parts = (*csg)->parts;
  if (parts.empty()) return Extent::everywhere();
  Extent extent = extent_of(parts.front(), transform);
  if ((*csg)->operation == Csg::Operation::difference) return extent;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const Extent other = extent_of(parts[i], transform);
    extent = (*csg)->operation == Csg::Operation::intersection ? extent.common(other) : extent.joined(other);
  }
  return extent;
}

} // namespace celltrace
