#include "scene_image/csg_tree.hpp"

#include "celltrace/error.hpp"
#include "geometry/shape_geometry.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/box_bounds.hpp"
#include "scene_image/csg_bounds.hpp"
#include "scene_image/object_records.hpp"

#include <algorithm>
#include <cmath>

namespace celltrace::csg {

using namespace kernel;

namespace {

/// Properties that an object inherits from the objects that contain it.
struct CsgContext {
  Transform transform;
  bool no_shadow = false, no_image = false, no_reflection = false;
  /// True if the object's own no_shadow, no_image and no_reflection have an effect. As in POV-Ray, all three
  /// have an effect in unions, but only no_reflection if a union is clipped or part of another operation. All
  /// but no_shadow have an effect in merges, and none in intersections and differences. An inverted operation
  /// follows the rule of the operation that it becomes.
  bool hides_shadow = true, hides_image = true, hides_reflection = true;
  bool is_in_unions = true; ///< true if only unions contain the object, and none of these is clipped
  bool inverse = false;
  bool was_inverse = false; ///< true if an object that contains this one is inverse
  bool shows = true;
  int depth = 0;
};

class TreeBuilder {
public:
  TreeBuilder(std::vector<SolidRecord>& solids, MeshInsides& meshes, ShapeDataTable& shape_data)
      : solids_(solids), meshes_(meshes), shape_data_(shape_data) {}

  Node build(const Object& object, CsgContext around) {
    if (around.depth++ > kDeepestCsg) throw InputError("the scene has a CSG that nests too deeply");
    if (!object.clipped_by || object.clipped_by->empty()) return build_unclipped(object, around);
    // If the clipped object is inverted, the objects that clip it are not.
    Node clipped;
    clipped.kind = Node::Kind::intersection;
    clipped.is_clipped = true;
    clipped.shows = around.shows;
    around.is_in_unions = false;
    clipped.add(build_unclipped(object, around));
    clipped.unseen_by = clipped.children.front().unseen_by;
    around.shows = false;
    around.inverse = false;
    for (const Object& clip : *object.clipped_by)
      clipped.add(build(clip, around));
    return clipped;
  }

private:
  Node build_unclipped(const Object& object, CsgContext around) {
    around.transform = object.transform.then(around.transform);
    around.no_shadow = around.no_shadow || (around.hides_shadow && object.no_shadow);
    around.no_image = around.no_image || (around.hides_image && object.no_image);
    around.no_reflection = around.no_reflection || (around.hides_reflection && object.no_reflection);
    around.inverse = around.inverse != object.inverse;
    around.was_inverse = around.was_inverse || around.inverse;
    if (const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape)) {
      if (!*csg) throw InputError("an object has no CSG");
      return seen_as(around, build_operation(**csg, around));
    }
    return seen_as(around, build_solid(object, around));
  }

  static Node seen_as(const CsgContext& around, Node node) {
    if (around.no_image) node.unseen_by |= object_flag::no_image;
    if (around.no_reflection) node.unseen_by |= object_flag::no_reflection;
    return node;
  }

  Node build_operation(const Csg& csg, CsgContext around) {
    using Operation = Csg::Operation;
    const bool joins = csg.operation == Operation::union_ || csg.operation == Operation::merge;
    Node node;
    node.shows = around.shows;
    if (joins == around.inverse)
      node.kind = Node::Kind::intersection;
    else // as in POV-Ray, an inverted intersection becomes a merge, even if it was a union before
      node.kind =
          csg.operation == Operation::union_ && !around.was_inverse ? Node::Kind::union_ : Node::Kind::merge;
    around.is_in_unions = around.is_in_unions && node.kind == Node::Kind::union_;
    around.hides_shadow = around.is_in_unions;
    around.hides_image = around.is_in_unions || node.kind == Node::Kind::merge;
    around.hides_reflection = node.kind != Node::Kind::intersection;
    const bool inverse = around.inverse;
    node.children.reserve(csg.parts.size());
    for (std::size_t i = 0; i < csg.parts.size(); ++i) {
      around.inverse = inverse != (csg.operation == Operation::difference && i > 0);
      node.add(build(csg.parts[i], around));
    }
    return node;
  }

  Node build_solid(const Object& object, const CsgContext& around) {
    Node node;
    node.inverse = around.inverse;
    node.shows = around.shows;
    node.object = object;
    node.object.transform = around.transform;
    node.object.inverse = around.inverse;
    node.object.no_shadow = around.no_shadow;
    node.object.no_image = around.no_image;
    node.object.no_reflection = around.no_reflection;
    node.object.clipped_by = nullptr;
    node.record = static_cast<std::uint32_t>(solids_.size());
    solids_.push_back(node.mesh() != nullptr ? place_mesh(node) : place_solid(node));
    node.is_bare = node.has_no_inside();
    if (node.mesh() == nullptr) node.box = box_along_axes(node.shape);
    node.needs_bounds = node.inverse ? node.box.has_value() : node.quadric() != nullptr;
    return node;
  }

  SolidRecord place_solid(Node& node) {
    node.shape = place_shape(node.object);
    SolidRecord solid{};
    solid.object.kind_and_flags =
        node.shape.is_empty || node.has_no_inside() ? kEmptySolid : node.shape.kind_and_flags;
    write_shape(node.shape, solid);
    if (kernel::Primitives::is_made_of_data(solid.object.kind_and_flags & kernel::object_flag::kind_mask)) {
      shape_data_.add(node.object);
      shape_data_.of(node.object).put_in(solid.extra);
    }
    return solid;
  }

  SolidRecord place_mesh(Node& node) {
    const Mesh& mesh = *node.mesh();
    node.mesh_bounds = bounds_of(mesh, node.object.transform);
    SolidRecord solid{};
    solid.object.kind_and_flags = kEmptySolid;
    if (!mesh.has_inside()) return solid;
    const MeshInsides::Inside& inside = meshes_.of(mesh);
    solid.object.kind_and_flags = kMeshSolid;
    solid.object.extra = inside.grid;
    write_map(node.object.transform.inverse().then(inside.to_grid_space), solid.object.geometry);
    return solid;
  }

  std::vector<SolidRecord>& solids_;
  MeshInsides& meshes_;
  ShapeDataTable& shape_data_;
};

} // namespace

Node build_tree(const Object& object, std::vector<SolidRecord>& solids, MeshInsides& meshes,
                ShapeDataTable& shape_data) {
  return TreeBuilder(solids, meshes, shape_data).build(object, {});
}

void add_boundaries(const Node& node, std::vector<SolidBoundary>& boundaries) {
  if (node.kind == Node::Kind::solid && node.mesh() == nullptr && has_boundary(node.shape))
    boundaries.push_back({node.record, node.shape});
  for (const Node& child : node.children)
    add_boundaries(child, boundaries);
}

bool is_plane(const Node& node) {
  return node.kind == Node::Kind::solid && node.mesh() == nullptr && !node.shape.is_empty &&
         (node.shape.kind_and_flags & object_flag::kind_mask) == kPrimitiveKind<PlanePrimitive>;
}

Aabb bounds_of(const Mesh& mesh, const Transform& transform) {
  Aabb box = kNowhere;
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    ProgressMonitor::check_cancelled(static_cast<std::size_t>(&triangle - mesh.triangles.data()));
    for (const Index vertex : triangle.vertex) {
      const Vec3 at = transform.point(Vec3(mesh.vertices[vertex]));
      for (int i = 0; i < 3; ++i) {
        const float slack = 1e-5f * (1.0f + static_cast<float>(std::abs(at[i])));
        box.min[i] = std::min(box.min[i], static_cast<float>(at[i]) - slack);
        box.max[i] = std::max(box.max[i], static_cast<float>(at[i]) + slack);
      }
    }
  }
  return box;
}

} // namespace celltrace::csg
