// Helpers shared by the code that writes ObjectRecords.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/accel/object_bounds.hpp"
#include "records/material.hpp"
#include "records/object.hpp"
#include "records/offsets.hpp"
#include "scene_image/interior_records.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace celltrace {

/// Counts of the records of a range of objects.
struct ObjectCounts {
  std::uint32_t objects = 0;             ///< number of objects that can be hit
  std::uint32_t extras = 0, blended = 0; ///< number of objects with such a record
  kernel::Aabb around = {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};

  static constexpr float kFar = 3e38f;
  void add(const ObjectCounts& other);
};

/// Returns whether a material with these flags looks the same from both sides and needs nothing but the point
/// on a surface.
inline bool is_of_points(std::uint32_t material_flags) {
  using namespace kernel;
  return (material_flags & (object_flag::two_sided | object_flag::by_surface)) == 0;
}
/// Returns whether a material is opaque, and is_of_points() is true for it.
inline bool is_plain(std::uint32_t material_flags) {
  return (material_flags & kernel::object_flag::opaque) != 0 && is_of_points(material_flags);
}

inline std::uint32_t offset_of_interior(std::uint32_t table_offset, Index interior) {
  return table_offset + interior * static_cast<std::uint32_t>(sizeof(kernel::InteriorRecord));
}

/// The tables that ObjectRecords refer to, and the tables' offsets in the image.
struct RecordTables {
  const Scene& scene;
  std::uint32_t material_offset, interior_offset, extra_offset, blend_offset;
  std::uint32_t csg_offset, shape_data_offset, instance_offset;
  kernel::ExtraRecord* extras;                      ///< table
  kernel::BlendRecord* blends;                      ///< table
  const std::vector<std::uint32_t>& material_flags; ///< TextureTables::object_flags

  std::uint32_t offset_of_material(Index index) const {
    return material_offset + index * static_cast<std::uint32_t>(sizeof(kernel::MaterialRecord));
  }
  /// Returns the offset of the interior of an object of the scene, or of a CSG part that has an interior.
  std::uint32_t interior_of(const Object& object) const {
    if (object.interior != kNoIndex) return offset_of_interior(interior_offset, object.interior);
    const auto index = static_cast<std::size_t>(&object - scene.objects.data());
    return offset_of_interior(interior_offset, own_interior(scene, index));
  }
  /// Sets the only material of a record; a blended record has several.
  void set_material(kernel::ObjectRecord& record, Index material) const {
    const std::uint32_t flags = material_flags[material];
    record.material = offset_of_material(material) | (flags & kernel::material_word::flags_mask);
    record.kind_and_flags |= flags & ~kernel::material_word::flags_mask;
  }
  /// Swaps the sides of a mesh's flat triangle if they look different: its normal points to the mesh's
  /// inside, unless `object` is a mirror image.
  static void change_sides(kernel::ObjectRecord& record, const Object& object) {
    if ((record.kind_and_flags & kernel::object_flag::two_sided) != 0 && object.transform.determinant() > 0)
      record.kind_and_flags ^= kernel::object_flag::inverse;
  }
  std::uint32_t offset_of_extra(std::uint32_t index) const {
    return extra_offset + index * static_cast<std::uint32_t>(sizeof(kernel::ExtraRecord));
  }
};

/// Returns the number of the set of lights that shine on an object: set 0 has all global lights, the sets of
/// light groups follow.
inline std::uint32_t light_set_of(const Object& object) {
  return object.light_group == kNoIndex ? 0 : object.light_group + 1;
}

/// Returns whether the material for an object's inside is seen where its normals point. POV-Ray inverts an
/// inverse quadric twice, in its coefficients and in its normals, so that for this purpose the quadric counts
/// as not inverse.
inline bool is_seen_inverse(const Object& object) {
  return object.inverse && !std::holds_alternative<Quadric>(object.shape);
}

/// Returns a record without a material, extras and geometry.
inline kernel::ObjectRecord start_record(const Object& object, std::uint32_t kind_and_flags,
                                         const RecordTables& tables) {
  kernel::ObjectRecord r{};
  r.kind_and_flags = kind_and_flags | (object.no_shadow ? kernel::object_flag::no_shadow : 0) |
                     (object.no_image ? kernel::object_flag::no_image : 0) |
                     (object.no_reflection ? kernel::object_flag::no_reflection : 0) |
                     (is_seen_inverse(object) ? kernel::object_flag::inverse : 0) |
                     (object.is_lit_through ? kernel::object_flag::lit_through : 0) |
                     light_set_of(object) << kernel::object_flag::light_set_shift;
  r.interior = tables.interior_of(object);
  r.extra = kernel::kNoOffset;
  return r;
}

/// Turns the record into a point that no ray sees, so that it keeps its place in the image until the object
/// is shown again.
void hide(kernel::ObjectRecord& record, const Vec3f& at);

/// Limit on the absolute values of coordinates: single precision must be able to hold their squares.
inline constexpr float kMostCoordinate = 1e18f;
bool has_size(const kernel::Aabb& box);
/// Throws InputError, naming the object by its index in the scene, unless all coordinates are within
/// kMostCoordinate.
void check_size(const kernel::Aabb& box, std::size_t object);

} // namespace celltrace
