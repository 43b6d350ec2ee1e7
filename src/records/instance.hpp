// Instances of meshes. Kernel dialect.
#pragma once

#include "records/offsets.hpp"

#include <stdint.h>

namespace celltrace::kernel {

// An instanced mesh is in the image once. Its triangles are ObjectRecords in the mesh's own space, in a
// separate table, in the order of the leaves of the mesh's own BVH. An instance is one object, whose
// intersection test traverses that BVH. A hit names a triangle of an instance by a number; the triangle's
// ObjectRecord in world space is made on demand.

/// Set in the number of an instance's triangle. No offset of an object has this bit in an image with
/// instances.
constexpr uint32_t kInstancedBit = 0x80000000u;
/// Returns true if the object that a ray hits or starts on is a triangle of an instance.
constexpr bool is_instanced(uint32_t object) {
  return object + 1 > kInstancedBit; // 0 for kNoOffset
}
/// Largest number of levels of an instanced mesh's BVH.
constexpr uint32_t kMaxMeshLevels = 16;

/// An instance of a mesh. A triangle of the mesh whose record has the material kNoOffset has the instance's
/// material. No material of the triangles or the instance lets light through, has patterns that need more of
/// a surface than points, or looks different from inside.
struct alignas(128) InstanceRecord {
  float to_world[12];       ///< the affine map from the mesh's space, three rows of four
  float normal_to_world[9]; ///< three rows
  uint32_t first_number;    ///< number of its first triangle; ascends through the table and begins at 1
  uint32_t triangle_count;
  uint32_t first_triangle; ///< offset of the mesh's first ObjectRecord
  uint32_t root;           ///< offset of the mesh's NodeRecord
  uint32_t kind_and_flags; ///< for triangles without a material of their own
  uint32_t material;       ///< material_word for triangles without a material of their own
  uint32_t interior;       ///< interior of all triangles
  uint32_t owner;          ///< index of the instance's object in the scene
  uint32_t unused[3];
};
static_assert(sizeof(InstanceRecord) == 128, "one a line");

} // namespace celltrace::kernel
