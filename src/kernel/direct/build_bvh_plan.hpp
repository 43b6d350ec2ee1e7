// The plan of a BVH build for the PPE: the number of SPEs, the steps, and the memory. Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"
#include "kernel/tuning.hpp"

#include <stdint.h>

namespace celltrace::kernel::bvh {

/// Largest number of SPEs that build at the same time.
constexpr uint32_t kMaxBuilders = 32;
/// Number of steps of a build, with a barrier after each: a step needs the results of all SPEs from the
/// previous one.
constexpr uint32_t kSteps = 3;

constexpr uint32_t kTreeletObjects = tuning::kTreeletObjects;
/// Number of references that fit into local store.
constexpr uint32_t kLocalReferences = 768;

/// The state of a build that its SPEs share, at the start of the work memory.
struct alignas(128) TeamRecord {
  uint32_t treelets;
  uint32_t top_nodes;
  uint32_t built_nodes; ///< nodes in the top levels and in treelets that are no copies, with gaps
  uint32_t nodes;       ///< nodes in the whole BVH
  uint32_t next;        ///< next treelet to build; the PPE stops the build with kStopped
  uint32_t next_copy;   ///< next treelet for the copying step
  uint32_t unused[26];
};
static_assert(sizeof(TeamRecord) == 128, "one line");
constexpr uint32_t kStopped = 0x80000000u;

/// Returns the largest number of nodes of a treelet: a node has four children, and a leaf at least one
/// object.
constexpr uint32_t most_treelet_nodes(uint32_t objects) {
  return (objects - 1) / 3;
}

/// Returns the largest number of nodes of a BVH. Without groups a node may have only two or three objects as
/// children: at worst all objects are in pairs, with two thirds as many nodes as objects. Nodes above copies
/// may have two or three children.
constexpr uint32_t most_nodes(uint32_t objects, uint32_t groups, bool copies) {
  return (groups == 0 ? 2 * objects : objects) / 3 + 2 + (copies ? groups : 0);
}

/// The size of the work memory.
struct WorkSize {
  uint32_t groups;
  uint32_t references; ///< number of objects if a treelet's might exceed kLocalReferences, otherwise 0

  constexpr WorkSize(uint32_t objects, uint32_t group_count, uint32_t longest_group)
      : groups(group_count),
        references((group_count == 0 ? objects : uint64_t{3} * longest_group) > kLocalReferences ? objects
                                                                                                 : 0) {}
  /// Returns the size of each of the two blocks, in pairs of 8 bytes: 4 for each reference to a group or an
  /// object; 5 for each treelet, at most one per group, or a word for each in the other block; a cache line.
  constexpr uint64_t pairs() const {
    return uint64_t{9} * groups + uint64_t{4} * references + kLineBytes / 8;
  }
};

} // namespace celltrace::kernel::bvh
