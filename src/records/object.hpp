// Objects: what rays are tested against. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// What an object record describes; low byte of ObjectRecord::kind_and_flags: the place of a shape in the
/// list of primitives/list.hpp, of which these are the first.
enum class ObjectKind : uint32_t { sphere = 0, triangle = 1, plane = 2, ellipsoid = 3 };
constexpr uint32_t kMaxPrimitives = 48;

namespace object_flag {
constexpr uint32_t kind_mask = 0x7F;
constexpr uint32_t smooth = 0x100;          ///< triangle with vertex normals
constexpr uint32_t no_shadow = 0x200;       ///< shadow rays pass
constexpr uint32_t opaque = 0x400;          ///< shadow rays stop
constexpr uint32_t blended = 0x800;         ///< `material` is the offset of a BlendRecord
constexpr uint32_t open = 0x1000;           ///< cylinder or cone without caps
constexpr uint32_t csg = 0x2000;            ///< part of a CSG: crossings count where its condition holds
constexpr uint32_t no_image = 0x10000;      ///< only rays that came by a mirror see it
constexpr uint32_t no_reflection = 0x20000; ///< and these do not
constexpr uint32_t selective = no_image | no_reflection;
constexpr uint32_t two_sided = 0x40000;   ///< another material where it is seen from inside,
constexpr uint32_t inverse = 0x80000;     ///< which is what else is outside
constexpr uint32_t by_surface = 0x100000; ///< some patterns of it ask for more of it than points
constexpr uint32_t flat_map = 0x200000;   ///< an ellipsoid whose surface coordinates are x and y
/// Light that falls on the other side counts as if it fell on this one.
constexpr uint32_t lit_through = 0x800000;
constexpr uint32_t light_set_shift = 24; ///< number of the set of lights that shine on it; 0: all global ones
constexpr uint32_t unused = 0x40C080;    ///< room for others
} // namespace object_flag

/// ObjectRecord::material: an offset, which is a multiple of 16, and what the shading of hits has to know of
/// the materials there before it reads them.
namespace material_word {
constexpr uint32_t flags_mask = 0xF;
constexpr uint32_t spawns = 0x1;     ///< secondary rays may leave some of them, or they are texture maps
constexpr uint32_t textured = 0x2;   ///< some are not the constants of their records alone
constexpr uint32_t disturbed = 0x4;  ///< some disturb normals
constexpr uint32_t lit_behind = 0x8; ///< some send on light that falls on the other side
constexpr uint32_t offset(uint32_t word) {
  return word & ~flags_mask;
}
} // namespace material_word

/// What an object has to have among its kind_and_flags: in the bits of `mask` those of `value`, and no
/// others.
struct ObjectFlags {
  uint32_t mask, value;

  constexpr bool are_in(uint32_t kind_and_flags) const { return (kind_and_flags & mask) == value; }
};
/// Triangles that are no part of a CSG, which all rays see.
constexpr ObjectFlags kPlainTriangle = {object_flag::kind_mask | object_flag::csg | object_flag::selective,
                                        static_cast<uint32_t>(ObjectKind::triangle)};
/// Those of them that occlude all light.
constexpr ObjectFlags kOpaqueTriangle = {kPlainTriangle.mask | object_flag::opaque | object_flag::no_shadow,
                                         kPlainTriangle.value | object_flag::opaque};

constexpr uint32_t kMaxLightSets = 1u << (32 - object_flag::light_set_shift);

/// Geometry by kind: sphere: centre (0..2), radius (3), the directions of its x axis (4..6) and y axis (7..9)
/// and 1 or, if it is mirrored, -1 (10), which are for its surface coordinates. Triangle: its vertices (0..2,
/// 3..5, 6..8). All others: the affine map from the world to the own space of the shape or the mesh, three
/// rows of four (xyz | offset).
struct alignas(64) ObjectRecord {
  uint32_t kind_and_flags;
  uint32_t material; ///< material_word of a MaterialRecord, or of a BlendRecord if `blended`
  uint32_t interior; ///< offset of an InteriorRecord; also identifies the inside
  uint32_t extra;    ///< offset of an ExtraRecord, or kNoOffset
  float geometry[12];
};
static_assert(sizeof(ObjectRecord) == 64, "two objects a line");

/// What few objects have. `value`: of a smooth triangle, the normals at its three vertices, xyz each, which
/// interpolate linearly and have any common length; of a shape in its own space, its parameters, of a polygon
/// those of PolygonEdges, of an instance the bits of its InstanceRecord's offset.
struct alignas(64) ExtraRecord {
  float value[9];
  uint32_t csg; ///< of objects with object_flag::csg: offset of a CsgRecord
  /// Of such objects and of instances: what may be there of them; least x, y, z, greatest x, y, z. But of
  /// triangles with object_flag::by_surface the surface coordinates u, v of their vertices, 0 if they have no
  /// such record.
  float bounds[6];
};
static_assert(sizeof(ExtraRecord) == 64, "two records a line");

/// An edge of a polygon, in the plane of its space, from its lower end up. It is beside points that are from
/// `low` on and below `high`: there it is at `column`, and `slope` more for each unit above `low`.
struct alignas(16) PolygonEdgeRecord {
  float low, high, column, slope;
};
static_assert(sizeof(PolygonEdgeRecord) == 16, "eight a line");

} // namespace celltrace::kernel
