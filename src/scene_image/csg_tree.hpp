// CSG as a tree whose solids alone are inverse.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"
#include "records/csg.hpp"
#include "scene_image/mesh_insides.hpp"
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

/// A node of the tree of one object, in which only solids are inverse: the inverse of an intersection is the
/// merge of the inverse parts, that of a union or merge the intersection, as POV-Ray has it.
struct Node {
  enum class Kind { solid, union_, merge, intersection };
  Kind kind = Kind::solid;
  bool inverse = false;        ///< of a solid
  bool shows = true;           ///< its surfaces are seen; not those of what clips
  bool is_clipped = false;     ///< its first child is, by the others
  Object object;               ///< of a solid
  PlacedShape shape;           ///< of a solid that is no mesh
  Aabb mesh_bounds;            ///< of a mesh
  std::optional<Aabb> box;     ///< of a solid that is a box along the axes of the world
  std::uint32_t record = 0;    ///< of a solid: index in CsgParts::solids
  std::uint32_t leaves = 1;    ///< solids in it
  std::uint32_t unseen_by = 0; ///< of object_flag::selective: rays that see none of it
  bool is_bare = false;        ///< it has a solid without an inside, which shows beyond what is inside of it
  bool needs_bounds = false;   ///< it has a quadric or an inverse box: what these leave depends on others
  std::vector<Node> children;

  /// Of a solid; null: no mesh.
  const Mesh* mesh() const {
    const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape);
    return mesh != nullptr ? mesh->get() : nullptr;
  }
  /// Of a solid that has no bounds by itself; null: no quadric.
  const Quadric* quadric() const {
    const bool may_be = kind == Kind::solid && !shape.is_empty && !shape.is_bounded;
    return may_be ? std::get_if<Quadric>(&object.shape) : nullptr;
  }
  /// No point is in it, nor in its inverse: a polygon, or a mesh without an inside vector.
  bool has_no_inside() const {
    return mesh() != nullptr ? !mesh()->has_inside()
                             : std::holds_alternative<std::shared_ptr<const Polygon>>(object.shape);
  }

  /// Rays that see other parts, but not this one. It hides nothing from them if the node is a merge.
  std::uint32_t hidden_from(const Node& child) const {
    return kind == Kind::merge ? child.unseen_by & ~unseen_by : 0;
  }
  /// Of the program that says whether a point is in a child.
  std::uint32_t steps_for(const Node& child) const {
    return child.leaves + (hidden_from(child) != 0 ? 1 : 0);
  }
  /// Whether it is in any.
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

/// Returns the tree of an object. Adds its solids to `solids` and what is inside of its meshes to `meshes`.
/// Throws InputError if it nests too deeply or has no CSG where one should be.
Node build_tree(const Object& object, std::vector<SolidRecord>& solids, MeshInsides& meshes);

/// Appends the boundaries of a tree's solids, of which programs ask what is inside.
void add_boundaries(const Node& node, std::vector<SolidBoundary>& boundaries);

bool is_plane(const Node& node);

/// Around all triangles in the world, and a little more.
Aabb bounds_of(const Mesh& mesh, const Transform& transform);

} // namespace celltrace::csg
