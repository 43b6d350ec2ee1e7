// CSG as a tree in which only solids (leaves) are inverse.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"
#include "records/csg.hpp"
#include "scene_image/mesh_insides.hpp"
#include "scene_image/shape_data_table.hpp"
#include "scene_image/shapes.hpp"
#include "scene_image/solid_boundary.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace celltrace::csg {

using kernel::Aabb;
using kernel::SolidRecord;

/// A node of the tree of one object. Only solids are inverse: as in POV-Ray, the inverse of an intersection
/// becomes the merge of the inverse parts, and the inverse of a union or merge becomes the intersection of
/// the inverse parts.
struct Node {
  enum class Kind { solid, union_, merge, intersection };
  Kind kind = Kind::solid;
  bool inverse = false;        ///< solids only
  bool shows = true;           ///< its surfaces are visible; false for objects that clip another object
  bool is_clipped = false;     ///< true if the other children clip the first child
  Object object;               ///< solids only
  PlacedShape shape;           ///< solids other than meshes
  Aabb mesh_bounds;            ///< meshes only
  std::optional<Aabb> box;     ///< solids that are boxes along the axes of the world
  std::uint32_t record = 0;    ///< solids only: index in CsgParts::solids
  std::uint32_t leaves = 1;    ///< number of solids in the tree below, including this node
  std::uint32_t unseen_by = 0; ///< flags of object_flag::selective, for the rays that see nothing of the node
  bool is_bare = false;      ///< has a solid without an inside, which is visible outside of the node's inside
  bool needs_bounds = false; ///< has a quadric or an inverse box: their bounds depend on other children
  std::vector<Node> children;

  /// Returns the mesh that a solid is; null if the solid is no mesh.
  const Mesh* mesh() const {
    const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape);
    return mesh != nullptr ? mesh->get() : nullptr;
  }
  /// Returns the quadric of a solid without bounds of its own; null for any other node.
  const Quadric* quadric() const {
    const bool may_be = kind == Kind::solid && !shape.is_empty && !shape.is_bounded;
    return may_be ? std::get_if<Quadric>(&object.shape) : nullptr;
  }
  /// Returns whether no point is in the solid nor in its inverse: true for a polygon and for a mesh without
  /// an inside vector.
  bool has_no_inside() const {
    return mesh() != nullptr ? !mesh()->has_inside()
                             : std::holds_alternative<std::shared_ptr<const Polygon>>(object.shape);
  }

  /// Returns the flags of rays that see the node, but not this child. In a merge, such a child does not hide
  /// the other children from these rays.
  std::uint32_t hidden_from(const Node& child) const {
    return kind == Kind::merge ? child.unseen_by & ~unseen_by : 0;
  }
  /// Returns the number of program steps that test whether a point is in a child.
  std::uint32_t steps_for(const Node& child) const {
    return child.leaves + (hidden_from(child) != 0 ? 1 : 0);
  }
  /// Returns the number of program steps that test all children.
  std::uint32_t steps() const {
    return std::accumulate(children.begin(), children.end(), 0u,
                           [this](std::uint32_t sum, const Node& child) { return sum + steps_for(child); });
  }

  void add(Node child) {
    leaves = (children.empty() ? 0 : leaves) + child.leaves;
    is_bare = is_bare || child.is_bare;
    needs_bounds = needs_bounds || child.needs_bounds;
    children.push_back(std::move(child));
  }
};

/// Returns the tree of an object. Adds its solids to `solids` the insides of its meshes to `meshes`, and the records of its shapes to `shape_data`.
/// Throws InputError if the object nests too deeply, or if an object that should be a CSG is null.
Node build_tree(const Object& object, std::vector<SolidRecord>& solids, MeshInsides& meshes,
                ShapeDataTable& shape_data);

/// Appends the boundaries of a tree's solids: programs test whether points are inside of these solids.
void add_boundaries(const Node& node, std::vector<SolidBoundary>& boundaries);

bool is_plane(const Node& node);

/// Returns slightly enlarged bounds of the mesh's triangles in the world.
Aabb bounds_of(const Mesh& mesh, const Transform& transform);

} // namespace celltrace::csg
