#include "scene/object_records.hpp"

#include "celltrace/error.hpp"

namespace celltrace {

using namespace kernel;

void ObjectCensus::add(const ObjectCensus& other) {
  objects += other.objects;
  smooth += other.smooth;
  blended += other.blended;
  around = box_around(around, other.around);
}

ObjectRecord start_record(const Object& object, ObjectKind kind, std::uint32_t interior_offset) {
  ObjectRecord r{};
  r.kind_and_flags = static_cast<std::uint32_t>(kind) | (object.no_shadow ? object_flag::no_shadow : 0);
  r.interior = interior_offset + object.interior * static_cast<std::uint32_t>(sizeof(InteriorRecord));
  r.normals = kNoOffset;
  return r;
}

void check_size(const Box& box) {
  constexpr float kMost = 1e18f;
  for (int i = 0; i < 3; ++i)
    if (!(box.min[i] > -kMost && box.max[i] < kMost))
      throw InputError(
          "the scene has an object that is too large, too thin or too far away for single precision");
}

} // namespace celltrace
