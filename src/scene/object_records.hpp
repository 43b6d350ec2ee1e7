// What all have in common that make the records of objects.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/primitives/overlap.hpp"
#include "kernel/records.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// What there is in a range of objects.
struct ObjectCensus {
  std::uint32_t objects = 0; ///< that can be hit
  std::uint32_t smooth = 0, blended = 0;
  kernel::Box around = {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};

  static constexpr float kFar = 3e38f;
  void add(const ObjectCensus& other);
};

/// Where records go that objects refer to, and where the tables lie in the image.
struct RecordTables {
  std::uint32_t material_offset, interior_offset, normals_offset, blend_offset;
  kernel::NormalsRecord* normals; ///< table
  kernel::BlendRecord* blends;    ///< table
  std::vector<bool> opaque;       ///< by material

  std::uint32_t offset_of_material(Index index) const {
    return material_offset + index * static_cast<std::uint32_t>(sizeof(kernel::MaterialRecord));
  }
  /// Not blended.
  void set_material(kernel::ObjectRecord& record, Index material) const {
    record.material = offset_of_material(material);
    if (opaque[material]) record.kind_and_flags |= kernel::object_flag::opaque;
  }
  std::uint32_t offset_of_normals(std::uint32_t index) const {
    return normals_offset + index * static_cast<std::uint32_t>(sizeof(kernel::NormalsRecord));
  }
};

/// A record without a material, without normals and without geometry.
inline kernel::ObjectRecord start_record(const Object& object, kernel::ObjectKind kind,
                                         std::uint32_t interior_offset) {
  kernel::ObjectRecord r{};
  r.kind_and_flags =
      static_cast<std::uint32_t>(kind) | (object.no_shadow ? kernel::object_flag::no_shadow : 0);
  r.interior = interior_offset + object.interior * static_cast<std::uint32_t>(sizeof(kernel::InteriorRecord));
  r.normals = kernel::kNoOffset;
  return r;
}

/// Throws InputError unless single precision holds the squares of an object's coordinates.
void check_size(const kernel::Box& box);

} // namespace celltrace
