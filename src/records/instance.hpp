// Instances of meshes. Kernel dialect.
#pragma once

#include "records/offsets.hpp"

#include <stdint.h>

namespace celltrace::kernel {

// Instances of a mesh of which the image has one copy. Its triangles are ObjectRecords in its own space, in a
// table apart, in the order of the leaves of a BVH that it has for itself. An instance is one object, whose
// test traverses that BVH. Hits name a triangle of an instance by a number, for which an ObjectRecord in the
// world is made where one is asked for.

/// Set in the numbers of such triangles, and in no offset that objects have in an image with instances.
constexpr uint32_t kInstancedBit = 0x80000000u;
/// Whether the object that a ray hits or starts on is such a triangle.
constexpr bool is_instanced(uint32_t object) {
  return object + 1 > kInstancedBit; // that of kNoOffset is 0
}
/// Levels of a mesh's BVH, at most.
constexpr uint32_t kMaxMeshLevels = 16;

/// The records of a mesh's triangles have the material kNoOffset where that is the instance's. Neither has
/// materials that let light through, ask for more of surfaces than points, or look different from inside.
struct alignas(128) InstanceRecord {
  float to_world[12];       ///< the affine map from the mesh's space, three rows of four
  float normal_to_world[9]; ///< three rows
  uint32_t first_number;    ///< of its triangles, in ascending order; the first one of all is 1
  uint32_t triangle_count;
  uint32_t first_triangle; ///< offset of the mesh's first ObjectRecord
  uint32_t root;           ///< offset of the mesh's NodeRecord
  uint32_t kind_and_flags; ///< of triangles without a material of their own
  uint32_t material;       ///< material_word of these
  uint32_t interior;       ///< of all
  uint32_t owner;          ///< index of its object in the scene
  uint32_t unused[3];
};
static_assert(sizeof(InstanceRecord) == 128, "one a line");

} // namespace celltrace::kernel
