// The tree of boxes that POV-Ray puts around a scene's objects. It decides which of two coinciding surfaces
// is visible: the surface that is tested first.
#pragma once

#include "geometry/extent.hpp"
#include "geometry/shape_geometry.hpp"

#include <cstddef>
#include <vector>

namespace celltrace {

/// A tree that is built as POV-Ray builds its tree, in the same order and precision. Thread safety: as a
/// standard container.
class BoundingTree {
public:
  /// Builds the tree of objects in the order of the scene. `lights` is the number of lights, which POV-Ray
  /// counts as objects.
  BoundingTree(const std::vector<Extent>& objects, std::size_t lights);

  /// Returns whether a ray that hits both objects at the same distance is tested against `a` first, if no
  /// other object lies before them.
  bool tests_first(std::size_t a, std::size_t b, const geometry::Ray& ray) const;

  /// Returns the rank of an object's leaf, from left to right. If a ray reaches two objects at the same
  /// distance, the object of lower rank is mostly tested first.
  std::size_t rank(std::size_t object) const { return ranks_[object]; }

private:
  struct Box {
    float low[3] = {}, size[3] = {};
  };
  struct Node {
    Box box;
    std::size_t object = 0;            ///< leaves only
    std::vector<std::size_t> children; ///< empty for a leaf
  };

  void build(std::vector<std::size_t>& nodes);
  std::size_t sort_and_cut(std::vector<std::size_t>& nodes, std::size_t first, std::size_t last) const;
  void add_parent(std::vector<std::size_t>& nodes, std::size_t first, std::size_t last);
  static Box around(const Box& a, const Box& b);

  std::vector<Node> nodes_;        ///< the root is the last node
  std::vector<std::size_t> ranks_; ///< index: object
  std::vector<bool> is_infinite_;
  bool is_list_; ///< true if there are so few objects that there is no tree
};

} // namespace celltrace
