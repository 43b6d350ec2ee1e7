// The insides of meshes that CSG asks for: the triangles of each as the kernel wants them, in a grid across
// the mesh's inside vector.
#pragma once

#include "celltrace/scene.hpp"
#include "records/mesh.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace celltrace {

/// Of all such meshes of a scene. Indices become offsets in the scene image.
class MeshInsides {
public:
  struct Inside {
    std::uint32_t grid;      ///< index in grids()
    Transform to_grid_space; ///< from the mesh's own
  };
  /// That of a mesh which has one. Each mesh is taken once, and has to stay.
  const Inside& of(const Mesh& mesh);

  /// `starts` is an index in words().
  const std::vector<kernel::MeshGridRecord>& grids() const { return grids_; }
  /// Of each grid, indices in words() of its lists, and behind them the lists, indices in triangles().
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
