// The BVH of a mesh by itself, in the mesh's space: for instances that share its triangles.
#pragma once

#include "kernel/aabb.hpp"
#include "records/accelerator.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace celltrace {

/// Over triangles with these bounds, of which there is one at least, and which stay in their order:
/// neighbours in it are to be neighbours in space. Nodes refer to children by their index, later ones than
/// theirs, leaves to triangles that follow each other by that of the first one. The root is the first node;
/// there are at most kernel::kMaxMeshLevels levels. Children that are not there have index 0 and no leaf, and
/// come last.
std::vector<kernel::NodeRecord> build_mesh_bvh(std::span<const kernel::Aabb> bounds);

} // namespace celltrace
