// The insides of meshes that CSG tests. The triangles of each mesh are laid out for the kernel in a grid at
// right angles to the mesh's inside vector.
#pragma once

#include "celltrace/scene.hpp"
#include "records/mesh.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace celltrace {

/// The insides of all meshes that a scene's CSG tests. TableWriter turns indices into offsets in the scene
/// image.
class MeshInsides {
public:
  struct Inside {
    std::uint32_t grid;      ///< index in grids()
    Transform to_grid_space; ///< map from the mesh's own space
  };
  /// Returns the inside of a mesh, which must have an inside vector. Adds a mesh only once; it must outlive
  /// this object.
  const Inside& of(const Mesh& mesh);

  /// Returns the grids, in which `starts` is an index in words().
  const std::vector<kernel::MeshGridRecord>& grids() const { return grids_; }
  /// Returns for each grid the index in words() of each cell's list, followed by the lists, which consist of
  /// indices in triangles().
  const std::vector<std::uint32_t>& words() const { return words_; }
  const std::vector<kernel::MeshTriangleRecord>& triangles() const { return triangles_; }

private:
  Inside add(const Mesh& mesh);
  void add_lists(kernel::MeshGridRecord& grid, std::uint32_t first_triangle);

  std::unordered_map<const Mesh*, Inside> insides_;
  std::vector<kernel::MeshGridRecord> grids_;
  std::vector<std::uint32_t> words_;
  std::vector<kernel::MeshTriangleRecord> triangles_;
};

} // namespace celltrace
