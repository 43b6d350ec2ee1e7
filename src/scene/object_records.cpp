#include "scene/object_records.hpp"

#include "celltrace/error.hpp"

namespace celltrace {

using namespace kernel;

void ObjectCensus::add(const ObjectCensus& other) {
  objects += other.objects;
  extras += other.extras;
  blended += other.blended;
  around = united(around, other.around);
}

void check_size(const Aabb& box) {
  constexpr float kMost = 1e18f;
  for (int i = 0; i < 3; ++i)
    if (!(box.min[i] > -kMost && box.max[i] < kMost))
      throw InputError(
          "the scene has an object that is too large, too thin or too far away for single precision");
}

} // namespace celltrace
