// The grid and the BVH. Kernel dialect.
#pragma once

#include "records/object.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// A voxel: where its list of object offsets starts, and how many there are.
struct alignas(8) CellRecord {
  uint32_t list; ///< offset of the first of `count` words
  uint32_t count;
};
static_assert(sizeof(CellRecord) == 8, "sixteen voxels a line");

/// Objects that are near each other and neighbours in the table, with a box around them.
struct alignas(32) GroupRecord {
  float min[3];
  uint32_t first; ///< index of an ObjectRecord
  float max[3];
  uint32_t count;
};
static_assert(sizeof(GroupRecord) == 32, "four groups a line");
/// A group may be a copy of an earlier one, its prototype: it has as many objects, each of which lies among
/// its neighbours as the one at the same place of the prototype does. Both have no more objects than this.
constexpr uint32_t kMaxCopiedObjects = 256;

/// The uniform grid. Voxel (x, y, z) has index x + y*cells[0] + z*cells[0]*cells[1].
struct alignas(16) GridRecord {
  float min[3];
  uint32_t cell_offset;
  float max[3];
  uint32_t list_offset;
  float cell_size[3];
  uint32_t list_capacity; ///< words
  float inverse_cell_size[3];
  uint32_t list_count; ///< words in use, set by PREPARE FRAME
  uint32_t cells[3];
  uint32_t row_of_cells; ///< cells[0] * cells[1]
};
static_assert(sizeof(GridRecord) == 80, "crosses DMA");

/// A node of the BVH, four children wide: their bounds, coordinate by coordinate, and what is
/// in them. A child without objects has a box that is empty (min > max).
struct alignas(128) NodeRecord {
  float bounds[6][4]; ///< min x, max x, min y, max y, min z, max z of each child
  uint32_t child[4];  ///< offset of its NodeRecord; of a leaf: of its first object, or of its list
  uint32_t leaf[4];   ///< the objects of a leaf; 0: a node, or nothing if the box is empty
};
static_assert(sizeof(NodeRecord) == 128, "one node a line");

/// NodeRecord::leaf: in the low 8 bits how many objects there are, above them by how many places each lies
/// after the one before it in the table, signed. That is 0 if they are listed, a word each, its offset.
namespace leaf_word {
constexpr uint32_t kCountBits = 8;
constexpr uint32_t make(uint32_t count, int32_t step) {
  return count | (static_cast<uint32_t>(step) << kCountBits);
}
constexpr uint32_t count(uint32_t word) {
  return word & ((1u << kCountBits) - 1);
}
constexpr bool is_list(uint32_t word) {
  return (word >> kCountBits) == 0;
}
/// From one object's offset to the next one's, modulo 2^32.
constexpr uint32_t step_bytes(uint32_t word) {
  return static_cast<uint32_t>(static_cast<int32_t>(word) >> kCountBits) *
         static_cast<uint32_t>(sizeof(ObjectRecord));
}
/// The greatest step that fits.
constexpr int32_t kMaxStep = (1 << (31 - kCountBits)) - 1;
/// Bytes that may be read from where a leaf's list begins, whatever its count.
constexpr uint32_t kReadableBytes = sizeof(ObjectRecord);
} // namespace leaf_word

/// the BVH. The root is the first node.
struct alignas(16) BvhRecord {
  uint32_t node_offset;
  uint32_t node_capacity; ///< nodes
  uint32_t node_count;    ///< in use, set by PREPARE FRAME
  uint32_t list_offset;   ///< a word per object, in the order of the leaves, of which lists take theirs
};
static_assert(sizeof(BvhRecord) == 16, "crosses DMA");

/// How rays find objects.
enum class AcceleratorKind : uint32_t { grid = 0, bvh = 1 };

} // namespace celltrace::kernel
