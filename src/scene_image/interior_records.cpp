#include "scene_image/interior_records.hpp"

#include <algorithm>
#include <memory>
#include <variant>

namespace celltrace {

namespace {

bool lacks_interior(const Object& object) {
  if (object.interior != kNoIndex) return false;
  const auto* const csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  return csg == nullptr || std::any_of((*csg)->parts.begin(), (*csg)->parts.end(), lacks_interior);
}

} // namespace

std::size_t interior_records(const Scene& scene) {
  const bool has_own = std::any_of(scene.objects.begin(), scene.objects.end(), lacks_interior);
  return scene.interiors.size() + (has_own ? scene.objects.size() : 0);
}

} // namespace celltrace
