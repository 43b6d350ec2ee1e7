// What the PPE has to know of how a BVH is built: by how many SPEs, in how many steps, in what memory.
// Kernel dialect.
#pragma once

#include "kernel/records.hpp"

#include <stdint.h>

namespace celltrace::kernel::bvh {

/// SPEs that build at a time.
constexpr uint32_t kMaxBuilders = 32;
/// Steps that several SPEs take one after the other; each needs what those before have done.
constexpr uint32_t kSteps = 3;

/// Part of the BVH that is built by itself: where it ends, unless there are fewer than four runs.
constexpr uint32_t kTreeletObjects = 64;
/// References that an SPE has room for.
constexpr uint32_t kLocalReferences = 768;

/// What all SPEs know of a build. A line, at the start of the work memory.
struct alignas(128) TeamRecord {
  uint32_t treelets;
  uint32_t top_nodes;
  uint32_t built_nodes; ///< of the upper part and of treelets that are no copies, with gaps
  uint32_t nodes;       ///< of all
  uint32_t next;        ///< treelet nobody has built; to stop the build, put kStopped here
  uint32_t next_copy;   ///< treelet nobody has looked at to copy it
  uint32_t unused[26];
};
static_assert(sizeof(TeamRecord) == 128, "one line");
constexpr uint32_t kStopped = 0x80000000u;

/// Nodes that a BVH has at most. Each has four children, and a leaf at least one object; but above
/// copies there may be nodes of two or three children.
constexpr uint32_t most_nodes(uint32_t objects, uint32_t runs, bool copies) {
  return objects / 3 + 2 + (copies ? runs : 0);
}

/// The size of the work memory, which lies in the sort buffers.
struct WorkSize {
  uint32_t runs;
  uint32_t references; ///< of objects, if an SPE might not have room for those of a treelet

  constexpr WorkSize(uint32_t objects, uint32_t group_count, uint32_t longest_group)
      : runs(group_count),
        references((group_count == 0 ? objects : uint64_t{3} * longest_group) > kLocalReferences ? objects : 0) {}
  /// Pairs of 8 bytes that each of the two sort buffers should have room for: 4 a reference, to a run or to
  /// an object; 5 a treelet, as many as runs, or a word in the other buffer; and a line.
  constexpr uint64_t pairs() const { return uint64_t{9} * runs + uint64_t{4} * references + kLineBytes / 8; }
};

} // namespace celltrace::kernel::bvh
