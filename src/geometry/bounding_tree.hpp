// The tree of boxes that POV-Ray puts around a scene's objects: it decides which of two surfaces at one place
// is visible, namely the one tested first.
#pragma once

#include "geometry/extent.hpp"
#include "geometry/shape_geometry.hpp"

#include <cstddef>
#include <vector>

namespace celltrace {

/// A tree that is built as POV-Ray builds it, in the same order and precision. Thread safety: as a standard
/// container.
class BoundingTree {
public:
  /// Builds the tree of objects in the order of the scene. `lights` is the number of lights, which count as
  /// objects, too.
  BoundingTree(const std::vector<Extent>& objects, std::size_t lights);

  /// Returns whether a ray that hits both objects at the same distance is tested for `a` first, if no other
  /// object lies before them.
  bool tests_first(std::size_t a, std::size_t b, const geometry::Ray& ray) const;

  /// Returns the index of an object's leaf, from left to right: of two objects that a ray reaches at the same
  /// distance, the one of lower rank is mostly tested first.
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

  std::vector<Node> nodes_;        ///< the last one is the root
  std::vector<std::size_t> ranks_; ///< index: object
  std::vector<bool> is_infinite_;
  bool is_list_; ///< true: there are so few objects that there is no tree
};

} // namespace celltrace
