// The BVH of a single mesh, in the mesh's space, for instances that share its triangles.
#pragma once

#include "kernel/aabb.hpp"
#include "records/accelerator.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace celltrace {

/// Builds a BVH over triangles with these bounds; there must be at least one triangle. Triangles are not
/// reordered: neighbours in their order should be neighbours in space. An inner node refers to each child by
/// the child's index, which is greater than the node's own. A leaf refers to consecutive triangles by the
/// index of the first triangle. The root is the first node; there are at most kernel::kMaxMeshLevels levels.
/// Missing children come last, with index 0 and no leaf.
std::vector<kernel::NodeRecord> build_mesh_bvh(std::span<const kernel::Aabb> bounds);

} // namespace celltrace
