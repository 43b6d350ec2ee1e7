// Objects: the records that rays are tested against. Kernel dialect.
#pragma once

#include <stdint.h>
#include <string.h>

namespace celltrace::kernel {

/// Kind of an object, in the low byte of ObjectRecord::kind_and_flags: the index of its shape in
/// primitives/list.hpp, which begins with these four.
enum class ObjectKind : uint32_t { sphere = 0, triangle = 1, plane = 2, ellipsoid = 3 };
constexpr uint32_t kMaxPrimitives = 48;

namespace object_flag {
constexpr uint32_t kind_mask = 0x7F;
constexpr uint32_t smooth = 0x100;          ///< triangle with vertex normals
constexpr uint32_t no_shadow = 0x200;       ///< shadow rays ignore the object
constexpr uint32_t opaque = 0x400;          ///< stops shadow rays
constexpr uint32_t blended = 0x800;         ///< `material` is the offset of a BlendRecord
constexpr uint32_t open = 0x1000;           ///< cylinder or cone without caps
constexpr uint32_t csg = 0x2000;            ///< part of a CSG: crossings count if its condition holds
constexpr uint32_t no_image = 0x10000;      ///< visible only to rays that came by a mirror
constexpr uint32_t no_reflection = 0x20000; ///< invisible to rays that came by a mirror
constexpr uint32_t selective = no_image | no_reflection;
constexpr uint32_t two_sided = 0x40000; ///< has another material where it is seen from inside
constexpr uint32_t inverse = 0x80000;   ///< inside and outside are swapped
constexpr uint32_t by_surface =
    0x100000; ///< some of its patterns read the surface's normals or coordinates, not only points
constexpr uint32_t flat_map = 0x200000; ///< an ellipsoid whose surface coordinates are x and y
/// Light that falls on the other side of the surface counts as if it fell on this side.
constexpr uint32_t lit_through = 0x800000;
constexpr uint32_t light_set_shift =
    24; ///< shift of the number of the object's set of lights; 0: all global lights
constexpr uint32_t unused = 0x40C080; ///< free bits
} // namespace object_flag

/// ObjectRecord::material: an offset, which is a multiple of 16, and flags that the shading of hits reads
/// before it reads the materials there.
namespace material_word {
constexpr uint32_t flags_mask = 0xF;
constexpr uint32_t spawns = 0x1; ///< secondary rays may leave some of the materials, or some are texture maps
constexpr uint32_t textured = 0x2;   ///< some materials are more than the constants of their records
constexpr uint32_t disturbed = 0x4;  ///< some materials disturb normals
constexpr uint32_t lit_behind = 0x8; ///< some materials send on light that falls on the other side
constexpr uint32_t offset(uint32_t word) {
  return word & ~flags_mask;
}
} // namespace material_word

/// A condition on kind_and_flags: the bits of `mask` have to be those of `value`.
struct ObjectFlags {
  uint32_t mask, value;

  constexpr bool are_in(uint32_t kind_and_flags) const { return (kind_and_flags & mask) == value; }
};
/// Triangles that are not part of a CSG and are visible to all rays.
constexpr ObjectFlags kPlainTriangle = {object_flag::kind_mask | object_flag::csg | object_flag::selective,
                                        static_cast<uint32_t>(ObjectKind::triangle)};
/// Plain triangles that occlude all light.
constexpr ObjectFlags kOpaqueTriangle = {kPlainTriangle.mask | object_flag::opaque | object_flag::no_shadow,
                                         kPlainTriangle.value | object_flag::opaque};

constexpr uint32_t kMaxLightSets = 1u << (32 - object_flag::light_set_shift);

/// An object. Geometry of a sphere: centre (0..2) and radius (3), and for surface coordinates the directions
/// of its x axis (4..6) and y axis (7..9) and 1, or -1 if the sphere is mirrored (10). Triangle: its vertices
/// (0..2, 3..5, 6..8). All others: the affine map from the world to the own space of the shape or mesh, three
/// rows of four (xyz | offset).
struct alignas(64) ObjectRecord {
  uint32_t kind_and_flags;
  uint32_t material; ///< material_word of a MaterialRecord, or of a BlendRecord if `blended`
  uint32_t interior; ///< offset of an InteriorRecord; also identifies the solid that a ray is in
  uint32_t extra;    ///< offset of an ExtraRecord, or kNoOffset
  float geometry[12];
};
static_assert(sizeof(ObjectRecord) == 64, "two objects a line");

/// Further data of some objects. `value` of a smooth triangle: the normals at its three vertices, xyz each,
/// which are interpolated linearly and have any common length; of a shape in its own space: its parameters;
/// of a shape with
/// kHasData: its ShapeData; of an instance: the bits of its InstanceRecord's offset.
struct alignas(64) ExtraRecord {
  float value[9];
  uint32_t csg; ///< for objects with object_flag::csg: offset of a CsgRecord
  /// For parts of CSG and for instances: the bounds of their visible parts; least x, y, z, greatest x, y, z.
  /// For triangles with object_flag::by_surface: the surface coordinates u, v of the three vertices, which
  /// are 0 if the triangle has no ExtraRecord.
  float bounds[6];
};
static_assert(sizeof(ExtraRecord) == 64, "two records a line");

/// Four numbers of a shape that has as many as it needs: an edge of a polygon, or a part of a polynomial, a
/// curve or a blob. The shape's file says what they mean.
struct alignas(16) ShapeDataRecord {
  float value[4];
};
static_assert(sizeof(ShapeDataRecord) == 16, "eight a line");

/// The ShapeDataRecords of one shape, in its ExtraRecord in place of the second and third value.
struct ShapeData {
  uint32_t first; ///< offset of a ShapeDataRecord
  uint32_t count;

  static ShapeData of(const ExtraRecord& extra) {
    ShapeData data;
    memcpy(&data, extra.value + 1, sizeof data);
    return data;
  }
  void put_in(ExtraRecord& extra) const { memcpy(extra.value + 1, this, sizeof *this); }
};

} // namespace celltrace::kernel
