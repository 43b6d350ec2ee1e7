#include "scene_image/object_records.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <iterator>
#include <string>

namespace celltrace {

using namespace kernel;

void ObjectCounts::add(const ObjectCounts& other) {
  objects += other.objects;
  extras += other.extras;
  blended += other.blended;
  around = united(around, other.around);
}

void hide(ObjectRecord& record, const Vec3f& at) {
  record.kind_and_flags =
      static_cast<std::uint32_t>(ObjectKind::sphere) | object_flag::no_shadow | object_flag::no_image |
      object_flag::no_reflection |
      (record.kind_and_flags & object_flag::blended); // tells which table `material` refers to
  std::fill(std::begin(record.geometry), std::end(record.geometry), 0.0f);
  for (int i = 0; i < 3; ++i)
    record.geometry[i] = at[i];
  record.extra = kNoOffset;
}

bool has_size(const Aabb& box) {
  for (int i = 0; i < 3; ++i)
    if (!(box.min[i] > -kMostCoordinate && box.max[i] < kMostCoordinate)) return false;
  return true;
}

void check_size(const Aabb& box, std::size_t object) {
  if (!has_size(box))
    throw InputError("object " + std::to_string(object) +
                     " is too large, too thin or too far away for single precision");
}

} // namespace celltrace
