// Bounds of the regions that nodes of a CSG may fill, and of the surfaces that nodes may show.
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

  /// Returns whether the intersection of all half-spaces may have tighter bounds than half_space() of each
  /// gives.
  bool limit_more() const { return has_slanted_; }

  /// Returns the part of a box that is in all half-spaces. The source of a face is the index, in
  /// CsgParts::solids, of the solid that has the face.
  Polytope cut_out_of(const Aabb& box) const;

private:
  void collect(const Node& intersection);

  std::vector<const Node*> planes_;
  bool has_slanted_ = false;
};

/// Calls `visit(child, index of the child)` for all children of a node. Children whose bounds depend on other
/// children come last.
template <class Visit> void for_each_child(const Node& node, const Visit& visit) {
  for (const bool last : {false, true})
    for (std::size_t i = 0; i < node.children.size(); ++i)
      if (node.children[i].needs_bounds == last) visit(node.children[i], i);
}

/// Returns bounds of the part of a box that a node may fill. The bounds and the box are in the world or, if
/// `space` is not null, in the space to which `space` transforms the world.
Aabb solid_bounds(const Node& node, const Aabb& within, const Transform* space = nullptr);

/// An intersection that limits a visible shape, and the index of the child of the intersection that contains
/// the shape.
struct Limit {
  const Node* intersection;
  std::size_t shown;
};

/// Returns bounds in the world of a quadric or a plane, computed along the shape's own axes; infinite if that
/// gives no bounds. Along its own axes, a shape in an object that has been turned as a whole may have bounds,
/// even if it has none along the axes of the world.
Aabb bounds_in_own_space(const Node& node, const std::vector<Limit>& limits);

} // namespace celltrace::csg
