// A BVH over the triangles of one mesh, in double precision, for queries of the scene language with one ray
// at a time. Rays of pictures use the BVH of the whole scene.
#pragma once

#include "geometry/shape_geometry.hpp"

#include <cstdint>
#include <vector>

namespace celltrace::geometry {

/// A BVH that refers to triangles by index, so that it also serves copies of the mesh. Thread safety: as a
/// standard container.
class TriangleTree {
public:
  explicit TriangleTree(const Mesh& mesh);

  /// Returns the indices of the triangles that the line of a ray may cross, ahead or behind, in ascending
  /// order.
  std::vector<std::uint32_t> along(const Ray& ray) const;

private:
  struct Node {
    Vec3f min, max;
    std::uint32_t begin, end; ///< range of a leaf, as indices in order_
    std::uint32_t right;      ///< index of the right child, 0 for a leaf; the left child is the next node
  };

  std::uint32_t build(const Mesh& mesh, const std::vector<Vec3>& centres, std::uint32_t begin,
                      std::uint32_t end);

  std::vector<std::uint32_t> order_; ///< all triangles, leaf by leaf
  std::vector<Node> nodes_;          ///< the root is the first node
  double size_ = 0;                  ///< largest coordinate
};

} // namespace celltrace::geometry
