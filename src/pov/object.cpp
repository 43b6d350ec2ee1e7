#include "pov/object.hpp"

namespace celltrace::pov {

void transform_limits(std::vector<Limit>& limits, const Transform& next) {
  for (Limit& limit : limits)
    limit.transform = limit.transform.then(next);
}

void ObjectDefinition::apply(const Transform& next) {
  transform = transform.then(next);
  if (texture && !uv_mapping) texture_transform = (*texture_transform).then(next);
  if (inside && !uv_mapping && !inside->is_constant()) inside = transformed(inside, next);
  transform_limits(clipped_by, next);
  transform_limits(bounded_by, next);
}

} // namespace celltrace::pov
