// The BVH of a single mesh, in the mesh's space, for instances that share its triangles.
#pragma once

#include "kernel/aabb.hpp"
#include "records/accelerator.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace celltrace {

/// Builds a BVH over triangles with these bounds, at least one. The triangles keep their order, in which
/// neighbours should be neighbours in space. Inner nodes refer to children by the index of the child, which
/// is greater than their own; leaves refer to consecutive triangles by the index of the first. The root is
/// the first node; there are at most kernel::kMaxMeshLevels levels. Missing children have index 0 and no
/// leaf, and come last.
std::vector<kernel::NodeRecord> build_mesh_bvh(std::span<const kernel::Aabb> bounds);

} // namespace celltrace
