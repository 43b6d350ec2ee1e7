// The grid and the BVH. Kernel dialect.
#pragma once

#include "records/object.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// A voxel of the grid: where its list of object offsets starts, and the list's length.
struct alignas(8) CellRecord {
  uint32_t list; ///< offset of the first of `count` words
  uint32_t count;
};
static_assert(sizeof(CellRecord) == 8, "sixteen voxels a line");

/// A group of objects that are near each other and neighbours in the object table, with its bounding box.
struct alignas(32) GroupRecord {
  float min[3];
  uint32_t first; ///< index of an ObjectRecord
  float max[3];
  uint32_t count;
};
static_assert(sizeof(GroupRecord) == 32, "four groups a line");
/// Largest number of objects of a group that is a copy of an earlier group, its prototype. A copy has as many
/// objects as its prototype, and object i of both groups has the same place among its neighbours.
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
  uint32_t list_count; ///< words in use; PREPARE FRAME sets this number
  uint32_t cells[3];
  uint32_t row_of_cells; ///< cells[0] * cells[1]
};
static_assert(sizeof(GridRecord) == 80, "crosses DMA");

/// A node of the BVH, four children wide: for each child its bounds, coordinate by coordinate, and a
/// reference to its contents. A child without objects has an empty box (min > max).
struct alignas(128) NodeRecord {
  float bounds[6][4]; ///< min x, max x, min y, max y, min z, max z of each child
  uint32_t child[4];  ///< offset of the child's NodeRecord; for a leaf: of its first object or of its list
  uint32_t leaf[4];   ///< the child's leaf word (see leaf_word); 0: a node, or no objects if the box is empty
};
static_assert(sizeof(NodeRecord) == 128, "one node a line");

/// NodeRecord::leaf. The low 8 bits are the number of objects. The bits above are the signed step, in
/// objects, from each object of the leaf to the next one in the object table. A step of 0 means that the leaf
/// has a list of object offsets, one word each.
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
/// Returns the step from one object's offset to the next one's, modulo 2^32.
constexpr uint32_t step_bytes(uint32_t word) {
  return static_cast<uint32_t>(static_cast<int32_t>(word) >> kCountBits) *
         static_cast<uint32_t>(sizeof(ObjectRecord));
}
/// Largest step that the bits of a leaf word can hold.
constexpr int32_t kMaxStep = (1 << (31 - kCountBits)) - 1;
/// Number of bytes that may be read from the beginning of a leaf's list, whatever its count.
constexpr uint32_t kReadableBytes = sizeof(ObjectRecord);
} // namespace leaf_word

/// The BVH of the scene. Its root is the first node.
struct alignas(16) BvhRecord {
  uint32_t node_offset;
  uint32_t node_capacity; ///< nodes
  uint32_t node_count;    ///< nodes in use; PREPARE FRAME sets this number
  uint32_t list_offset;   ///< offset of one word per object, in the order of the leaves; lists of leaves are
                          ///< parts of this table
};
static_assert(sizeof(BvhRecord) == 16, "crosses DMA");

/// Kind of accelerator by which rays find objects.
enum class AcceleratorKind : uint32_t { grid = 0, bvh = 1 };

} // namespace celltrace::kernel
