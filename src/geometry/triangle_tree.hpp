// A BVH over the triangles of one mesh, in double precision: for what the language asks of meshes, a ray at a
// time. Rays of pictures have their own, of the whole scene.
#pragma once

#include "geometry/shape_geometry.hpp"

#include <cstdint>
#include <vector>

namespace celltrace::geometry {

/// Refers to triangles by their index, so that a copy of the mesh has the same tree. Thread safety: as a
/// standard container.
class TriangleTree {
public:
  explicit TriangleTree(const Mesh& mesh);

  /// Indices of those that the line of a ray may cross, ahead or behind, in ascending order.
  std::vector<std::uint32_t> along(const Ray& ray) const;

private:
  struct Node {
    Vec3f min, max;
    std::uint32_t begin, end; ///< of a leaf, in order_
    std::uint32_t right;      ///< the left child is next; 0: a leaf
  };

  std::uint32_t build(const Mesh& mesh, const std::vector<Vec3>& centres, std::uint32_t begin,
                      std::uint32_t end);

  std::vector<std::uint32_t> order_; ///< all triangles, leaf by leaf
  std::vector<Node> nodes_;          ///< the first one is the root
  double size_ = 0;                  ///< the largest coordinate
};

} // namespace celltrace::geometry
