// The BVH for single rays: eight children wide, with triangles in blocks of four that are ready to be tested.
// This BVH is made from the contents of the leaves of the BVH for packets, which suit sixteen lanes.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// A reference to a child of a node. An empty child has an empty box, so that rays never hit it.
namespace query_ref {
constexpr uint32_t kKindShift = 30;
enum Kind : uint32_t {
  node,      ///< index of a node
  triangles, ///< index of a block
  others,    ///< index of the first of a list of other objects
};
constexpr uint32_t make(Kind kind, uint32_t index) {
  return static_cast<uint32_t>(kind) << kKindShift | index;
}
constexpr uint32_t kind(uint32_t ref) {
  return ref >> kKindShift;
}
constexpr uint32_t index(uint32_t ref) {
  return ref & ((1u << kKindShift) - 1);
}
} // namespace query_ref

struct alignas(64) QueryNode {
  static constexpr uint32_t kWidth = 8;
  float bounds[6][kWidth]; ///< min x, max x, min y, max y, min z, max z of each child
  uint32_t child[kWidth];
};

/// A leaf. Unused lanes repeat the first triangle.
struct alignas(16) TriangleBlock {
  float v0[3][4], edge1[3][4], edge2[3][4];
  uint32_t offset[4]; ///< offsets of the triangles' records in the scene image
};

struct QueryBvh {
  const QueryNode* nodes; ///< the first is the root
  const TriangleBlock* blocks;
  const uint32_t* others; ///< offsets; kNoOffset ends a list
};

} // namespace celltrace::kernel
