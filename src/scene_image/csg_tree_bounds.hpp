// Boxes around what the nodes of a CSG may fill, and show.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"
#include "scene_image/csg_tree.hpp"
#include "scene_image/polytope.hpp"

#include <cstddef>
#include <vector>

namespace celltrace::csg {

/// The half-spaces of an intersection, of intersections in it too.
class HalfSpaces {
public:
  explicit HalfSpaces(const Node& intersection) { collect(intersection); }

  /// Whether they say more than half_space() of each does.
  bool limit_more() const { return has_slanted_; }

  /// What they leave of a box. Each is the source of its face by its number among the solids.
  Polytope cut_out_of(const Aabb& box) const;

private:
  void collect(const Node& intersection);

  std::vector<const Node*> planes_;
  bool has_slanted_ = false;
};

/// Calls `visit(child, its number)` with all children of a node, with those last that others may limit.
template <class Visit> void for_each_child(const Node& node, const Visit& visit) {
  for (const bool last : {false, true})
    for (std::size_t i = 0; i < node.children.size(); ++i)
      if (node.children[i].needs_bounds == last) visit(node.children[i], i);
}

/// What a node may fill of a box; in the world, or in a space that the world is taken to.
Aabb solid_bounds(const Node& node, const Aabb& within, const Transform* space = nullptr);

/// One of the intersections that a shape is shown in, and which of its children that is in.
struct Limit {
  const Node* intersection;
  std::size_t shown;
};

/// Bounds of a quadric or a plane along its own axes, around which there may be some where there are none
/// along those of the world: around what has been turned as a whole. Infinite if not.
Aabb bounds_in_own_space(const Node& node, const std::vector<Limit>& limits);

} // namespace celltrace::csg
