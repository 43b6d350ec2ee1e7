// Bounds of what the nodes of a CSG may fill, and of the surfaces they may show.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"
#include "scene_image/csg_tree.hpp"
#include "scene_image/polytope.hpp"

#include <cstddef>
#include <vector>

namespace celltrace::csg {

/// The half-spaces of an intersection, including those of intersections nested in it.
class HalfSpaces {
public:
  explicit HalfSpaces(const Node& intersection) { collect(intersection); }

  /// Returns whether all half-spaces together may limit more than half_space() of each one does.
  bool limit_more() const { return has_slanted_; }

  /// Returns the part of a box that is in all half-spaces. The source of each face is the number of the
  /// half-space's solid.
  Polytope cut_out_of(const Aabb& box) const;

private:
  void collect(const Node& intersection);

  std::vector<const Node*> planes_;
  bool has_slanted_ = false;
};

/// Calls `visit(child, index of the child)` with all children of a node; children that others may limit come
/// last.
template <class Visit> void for_each_child(const Node& node, const Visit& visit) {
  for (const bool last : {false, true})
    for (std::size_t i = 0; i < node.children.size(); ++i)
      if (node.children[i].needs_bounds == last) visit(node.children[i], i);
}

/// Returns bounds of the part of a box that a node may fill, in the world or, if `space` is given, in the
/// space that it takes the world to.
Aabb solid_bounds(const Node& node, const Aabb& within, const Transform* space = nullptr);

/// An intersection that limits a visible shape, and the index of the intersection's child that contains the
/// shape.
struct Limit {
  const Node* intersection;
  std::size_t shown;
};

/// Returns bounds of a quadric or a plane along its own axes; infinite if there are none. A shape in an
/// object that has been turned as a whole may have such bounds even if it has none along the axes of the
/// world.
Aabb bounds_in_own_space(const Node& node, const std::vector<Limit>& limits);

} // namespace celltrace::csg
