// Meshes in CSG without an inside vector, of which POV-Ray misses some crossings with a ray. Their triangles
// are stored in a tree of boxes, laid out for the kernel.
#pragma once

#include "celltrace/scene.hpp"
#include "records/mesh.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace celltrace {

/// The trees of all such meshes of a scene, one for each mesh. TableWriter turns their indices into offsets
/// in the scene image.
class CrossedMeshes {
public:
  /// Returns the index of the first record of a mesh's tree. The mesh has a triangle with an area, and must
  /// outlive this object.
  std::uint32_t of(const Mesh& mesh);

  /// Returns the records of all trees; `next` is an index.
  const std::vector<kernel::CrossedMeshRecord>& records() const { return records_; }

private:
  std::unordered_map<const Mesh*, std::uint32_t> first_;
  std::vector<kernel::CrossedMeshRecord> records_;
};

} // namespace celltrace
