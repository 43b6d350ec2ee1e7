#include "scene_image/csg_parts.hpp"

#include "celltrace/error.hpp"
#include "geometry/extent.hpp"
#include "geometry/shape_geometry.hpp"
#include "kernel/accel/object_bounds.hpp"
#include "scene/build_watch.hpp"
#include "scene_image/box_bounds.hpp"
#include "scene_image/convex_solid.hpp"
#include "scene_image/csg_bounds.hpp"
#include "scene_image/interior_records.hpp"
#include "scene_image/object_records.hpp"
#include "scene_image/polytope.hpp"
#include "scene_image/quadric_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <glm/common.hpp>

namespace celltrace {

using namespace kernel;

namespace {

bool is_bounded(const Aabb& box) {
  constexpr float kMost = 1e18f;
  for (int i = 0; i < 3; ++i)
    if (!(box.min[i] > -kMost && box.max[i] < kMost)) return false;
  return true;
}

/// The half-space of a plane that is at right angles to an axis; else everywhere.
Aabb half_space(const PlacedShape& plane, bool inverse) {
  Aabb box = kEverywhere;
  const float* n = plane.geometry + 8;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(n[(i + 1) % 3]) > 1e-6f || std::abs(n[(i + 2) % 3]) > 1e-6f) continue;
    // n x + d < 0.
    const float at = -n[3] / n[i];
    if ((n[i] > 0) != inverse)
      box.max[i] = at + slack_at(at);
    else
      box.min[i] = at - slack_at(at);
  }
  return box;
}

/// Around a box after a transformation, and a little more.
Aabb moved(const Aabb& box, const Transform& transform) {
  const Extent around =
      Extent{Vec3(box.min[0], box.min[1], box.min[2]), Vec3(box.max[0], box.max[1], box.max[2])};
  if (around.is_everywhere()) return kEverywhere;
  const Extent extent = around.moved(transform);
  Aabb result;
  for (int i = 0; i < 3; ++i) {
    result.min[i] = static_cast<float>(extent.min[i] - 1e-5 * (1 + std::abs(extent.min[i])));
    result.max[i] = static_cast<float>(extent.max[i] + 1e-5 * (1 + std::abs(extent.max[i])));
  }
  return result;
}

/// Around all triangles in the world, and a little more.
Aabb bounds_of(const Mesh& mesh, const Transform& transform) {
  Aabb box = kNowhere;
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    BuildWatch::look_at(static_cast<std::size_t>(&triangle - mesh.triangles.data()));
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

/// What comes to an object from around it.
struct Surroundings {
  Transform transform;
  bool no_shadow = false, no_image = false, no_reflection = false;
  /// Whether what the object says of these counts. So it is in POV-Ray: in unions all of it, but where they
  /// are clipped or parts of other operations only no_reflection; in merges all but no_shadow; in
  /// intersections and differences nothing. What is inverted counts as what it becomes.
  bool hides_shadow = true, hides_image = true, hides_reflection = true;
  bool is_in_unions = true; ///< alone, and in none that is clipped
  bool inverse = false;
  bool was_inverse = false; ///< somewhere on the way
  bool shows = true;
  int depth = 0;
};

void write_shape(const PlacedShape& shape, SolidRecord& solid) {
  std::copy(shape.geometry, shape.geometry + 12, solid.object.geometry);
  std::copy(shape.parameters, shape.parameters + 2, solid.extra.value);
}

/// Moves the boundaries of a tree's solids, of which programs ask what is inside.
void move_boundaries(const Node& node, const Eye& eye, std::vector<SolidRecord>& solids) {
  if (node.kind == Node::Kind::solid) {
    if (node.mesh() == nullptr) write_shape(with_boundary(node.shape, eye), solids[node.record]);
    return;
  }
  for (const Node& child : node.children)
    move_boundaries(child, eye, solids);
}

class TreeBuilder {
public:
  TreeBuilder(std::vector<SolidRecord>& solids, MeshInsides& meshes) : solids_(solids), meshes_(meshes) {}

  Node build(const Object& object, Surroundings around) {
    if (around.depth++ > kDeepestCsg) throw InputError("the scene has a CSG that nests too deeply");
    if (!object.clipped_by || object.clipped_by->empty()) return build_unclipped(object, around);
    // What clips is not inverted with what it clips.
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
  Node build_unclipped(const Object& object, Surroundings around) {
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

  static Node seen_as(const Surroundings& around, Node node) {
    if (around.no_image) node.unseen_by |= object_flag::no_image;
    if (around.no_reflection) node.unseen_by |= object_flag::no_reflection;
    return node;
  }

  Node build_operation(const Csg& csg, Surroundings around) {
    using Operation = Csg::Operation;
    const bool joins = csg.operation == Operation::union_ || csg.operation == Operation::merge;
    Node node;
    node.shows = around.shows;
    if (joins == around.inverse)
      node.kind = Node::Kind::intersection;
    else // in POV-Ray an intersection that is inverted becomes a merge, whatever it was before
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

  Node build_solid(const Object& object, const Surroundings& around) {
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

  static SolidRecord place_solid(Node& node) {
    node.shape = place_shape(node.object);
    SolidRecord solid{};
    solid.object.kind_and_flags =
        node.shape.is_empty || node.has_no_inside() ? kEmptySolid : node.shape.kind_and_flags;
    write_shape(node.shape, solid);
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
};

bool is_plane(const Node& node) {
  return node.kind == Node::Kind::solid && node.mesh() == nullptr && !node.shape.is_empty &&
         (node.shape.kind_and_flags & object_flag::kind_mask) == kPrimitiveKind<PlanePrimitive>;
}

/// The half-spaces of an intersection, of intersections in it too.
class HalfSpaces {
public:
  explicit HalfSpaces(const Node& intersection) { collect(intersection); }

  /// Whether they say more than half_space() of each does.
  bool limit_more() const { return has_slanted_; }

  /// What they leave of a box. Each is the source of its face by its number among the solids.
  Polytope cut_out_of(const Aabb& box) const {
    Polytope polytope(box);
    for (const Node* plane : planes_) {
      const float* n = plane->shape.geometry + 8;
      const double sign = plane->inverse ? -1 : 1;
      polytope.cut(sign * Vec3(n[0], n[1], n[2]), -sign * n[3], plane->record);
    }
    return polytope;
  }

private:
  /// Of more planes than this the others are left out: the time grows with the square.
  static constexpr std::size_t kMost = 1000;

  void collect(const Node& intersection) {
    for (const Node& child : intersection.children) {
      if (child.kind == Node::Kind::intersection) collect(child);
      if (!is_plane(child) || planes_.size() == kMost) continue;
      planes_.push_back(&child);
      const float* n = child.shape.geometry + 8;
      has_slanted_ = has_slanted_ || (n[0] != 0) + (n[1] != 0) + (n[2] != 0) > 1;
    }
  }

  std::vector<const Node*> planes_;
  bool has_slanted_ = false;
};

/// Calls `visit(child, its number)` with all children of a node, with those last that others may limit.
template <class Visit> void for_each_child(const Node& node, const Visit& visit) {
  for (const bool last : {false, true})
    for (std::size_t i = 0; i < node.children.size(); ++i)
      if (node.children[i].needs_bounds == last) visit(node.children[i], i);
}

/// A solid that is no mesh, in a space that the world is taken to, if that is not null.
PlacedShape placed_in(const Transform* space, const Node& node) {
  if (space == nullptr) return node.shape;
  Object object = node.object;
  object.transform = object.transform.then(*space);
  return place_shape(object);
}

/// What a node may fill of a box; in the world, or in a space that the world is taken to.
Aabb solid_bounds(const Node& node, const Aabb& within, const Transform* space = nullptr) {
  Aabb all = node.kind == Node::Kind::intersection ? within : kNowhere;
  switch (node.kind) {
  case Node::Kind::solid: {
    if (node.has_no_inside()) return kNowhere;
    if (node.mesh() != nullptr) {
      if (node.inverse) return kEverywhere;
      return space == nullptr || is_empty(node.mesh_bounds) ? node.mesh_bounds
                                                            : moved(node.mesh_bounds, *space);
    }
    if (node.shape.is_empty) return node.inverse ? kEverywhere : kNowhere;
    if (is_plane(node)) return half_space(placed_in(space, node), node.inverse);
    if (const Quadric* quadric = node.quadric(); quadric != nullptr && !node.inverse) {
      const Transform& transform = node.object.transform;
      return bounds_of_quadric(*quadric, space != nullptr ? transform.then(*space) : transform, true, within);
    }
    if (node.box && node.inverse && space == nullptr) return left_by_box(*node.box, within);
    // The inside of a disc is a half-space.
    if (node.inverse || !node.shape.is_bounded ||
        (node.shape.kind_and_flags & object_flag::kind_mask) == kPrimitiveKind<DiscPrimitive>)
      return kEverywhere;
    return placed_in(space, node).bounds();
  }
  case Node::Kind::intersection:
    for_each_child(node, [&](const Node& child, std::size_t) {
      all = intersected(all, solid_bounds(child, all, space));
    });
    if (space != nullptr) return all;
    if (const HalfSpaces planes(node); planes.limit_more() && !is_empty(all))
      all = intersected(all, planes.cut_out_of(all).bounds());
    return all;
  default:
    for (const Node& child : node.children)
      all = united(all, solid_bounds(child, within, space));
    return all;
  }
}

/// One of the intersections that a shape is shown in, and which of its children that is in.
struct Limit {
  const Node* intersection;
  std::size_t shown;
};

/// Whether a transformation takes some axis to what is none.
bool turns_axes(const Transform& transform) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 row = glm::abs(transform.rows[i]);
    if (row.x + row.y + row.z > (1 + 1e-6) * std::max({row.x, row.y, row.z})) return true;
  }
  return false;
}

/// Bounds of a quadric or a plane along its own axes, around which there may be some where there are none
/// along those of the world: around what has been turned as a whole. Infinite if not.
Aabb bounds_in_own_space(const Node& node, const std::vector<Limit>& limits) {
  if (node.mesh() != nullptr || node.shape.is_bounded || !turns_axes(node.object.transform))
    return kEverywhere;
  constexpr std::uint32_t kMostSolids = 100; // of all that is asked for each of many shapes
  std::uint32_t solids = 0;
  for (const Limit& limit : limits)
    solids += limit.intersection->leaves;
  if (solids > kMostSolids) return kEverywhere;
  const Transform own = node.object.transform.inverse();
  Aabb box = kEverywhere;
  if (is_plane(node)) {
    const PlacedShape plane = placed_in(&own, node);
    box = intersected(half_space(plane, false), half_space(plane, true));
  }
  for (const bool last : {false, true})
    for (const Limit& limit : limits)
      for (const Node& child : limit.intersection->children)
        if (&child != &limit.intersection->children[limit.shown] && child.needs_bounds == last)
          box = intersected(box, solid_bounds(child, box, &own));
  if (const Quadric* quadric = node.quadric()) box = bounds_of_quadric(*quadric, Transform(), false, box);
  return is_bounded(box) && !is_empty(box) ? moved(box, node.object.transform) : kEverywhere;
}

/// Cuts a solid by all that a node consists of. False: that is not convex, or its materials ask for more than
/// triangles tell.
bool cut(ConvexSolid& solid, const Node& node, const std::vector<std::uint32_t>& material_flags) {
  if (!node.shows || node.is_clipped) return false;
  if (node.kind == Node::Kind::solid)
    return !node.shape.is_empty && is_of_points(material_flags[node.object.material]) &&
           solid.cut(node.object);
  return node.kind == Node::Kind::intersection &&
         std::all_of(node.children.begin(), node.children.end(),
                     [&](const Node& child) { return cut(solid, child, material_flags); });
}

/// Appends what a tree shows to the tables.
class Flattener {
public:
  /// Makes boxes or meshes of solids between planes if `material_flags` is not null.
  Flattener(CsgParts& to, const std::vector<std::uint32_t>* material_flags)
      : to_(to), material_flags_(material_flags) {}

  /// A condition that holds inside of a tree.
  void add_inside(const Node& tree) {
    CsgRecord record{};
    record.next = kNoCondition;
    record.steps = static_cast<std::uint32_t>(to_.steps.size());
    compile(tree, 0, kCsgAccept, kCsgReject);
    record.count = static_cast<std::uint32_t>(to_.steps.size()) - record.steps;
    to_.conditions.push_back(record);
  }

  /// The surfaces in `node` are there where the condition holds and inside `bounds`.
  void show(const Node& node, std::uint32_t condition, const Aabb& bounds) {
    if (!node.shows || is_empty(bounds)) return;
    if (node.kind == Node::Kind::solid) return show_solid(node, condition, bounds);
    if (condition == kNoCondition && show_convex(node)) return;
    if (node.kind == Node::Kind::union_ || node.children.size() < 2) {
      for (const Node& child : node.children)
        show(child, condition, bounds);
      return;
    }
    const std::size_t first = to_.parts.size();
    const auto steps = static_cast<std::uint32_t>(to_.steps.size());
    compile_siblings(node);
    std::vector<Aabb> filled;
    std::optional<Polytope> polytope;
    if (node.kind == Node::Kind::intersection) {
      Aabb all = bounds;
      filled.assign(node.children.size(), kEverywhere);
      for_each_child(node, [&](const Node& child, std::size_t i) {
        filled[i] = solid_bounds(child, all);
        // What has no inside shows what is in all others.
        if (!child.is_bare) all = intersected(all, filled[i]);
      });
      if (const HalfSpaces planes(node); planes.limit_more() && !is_empty(all))
        polytope = planes.cut_out_of(all);
    }
    const std::uint32_t count = node.steps();
    std::uint32_t begin = 0;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      const Node& child = node.children[i];
      CsgRecord record{};
      record.next = condition;
      record.steps = steps;
      record.count = count;
      record.skip_begin = begin;
      record.skip_end = begin += node.steps_for(child);
      Aabb inside = bounds;
      for (std::size_t other = 0; other < filled.size(); ++other)
        if (other != i) inside = intersected(inside, filled[other]);
      if (polytope)
        inside = intersected(inside,
                             is_plane(child) ? polytope->bounds_of_face(child.record) : polytope->bounds());
      to_.conditions.push_back(record);
      if (node.kind == Node::Kind::intersection) limits_.push_back({&node, i});
      const auto number = static_cast<std::uint32_t>(to_.conditions.size()) - 1;
      if (!node.is_clipped)
        show_reversed(child, number, inside);
      else if (child.kind == Node::Kind::union_)
        for (const Node& part : child.children)
          show_reversed(part, number, inside);
      else
        show(child, number, inside);
      if (node.kind == Node::Kind::intersection) limits_.pop_back();
    }
    if (condition == kNoCondition) reverse_from(first);
  }

private:
  /// Of surfaces at one place the kernel shows that of the first part. In POV-Ray the last one that is found
  /// counts, and an intersection or a merge takes what is found of each part from the last on; so does a
  /// clipped union.
  void show_reversed(const Node& node, std::uint32_t condition, const Aabb& bounds) {
    const std::size_t first = to_.parts.size();
    show(node, condition, bounds);
    reverse_from(first);
  }
  void reverse_from(std::size_t first) {
    std::reverse(to_.parts.begin() + static_cast<std::ptrdiff_t>(first), to_.parts.end());
  }

  /// The program of which every child's condition leaves out the child itself: in an intersection all others
  /// have to be filled, in a merge none.
  void compile_siblings(const Node& node) {
    const bool all = node.kind == Node::Kind::intersection;
    const std::uint32_t count = node.steps();
    std::uint32_t position = 0;
    for (const Node& child : node.children) {
      const std::uint32_t after = position + node.steps_for(child);
      const std::uint32_t go_on = after == count ? kCsgAccept : after;
      if (const std::uint32_t rays = node.hidden_from(child); rays != 0)
        to_.steps.push_back({first_solid(child), ++position, go_on, rays});
      compile(child, position, all ? go_on : kCsgReject, all ? kCsgReject : go_on);
      position = after;
    }
  }
  static std::uint32_t first_solid(const Node& node) {
    return node.children.empty() ? node.record : first_solid(node.children.front());
  }
  /// Goes on at step `if_inside` where a point is in the node, else at `if_outside`.
  void compile(const Node& node, std::uint32_t position, std::uint32_t if_inside, std::uint32_t if_outside) {
    if (node.kind == Node::Kind::solid) {
      if (node.inverse && !node.has_no_inside()) std::swap(if_inside, if_outside);
      to_.steps.push_back({node.record, if_inside, if_outside, 0});
      return;
    }
    const bool all = node.kind == Node::Kind::intersection;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      const Node& child = node.children[i];
      const std::uint32_t after = position + child.leaves;
      const bool last = i + 1 == node.children.size();
      compile(child, position, all && !last ? after : if_inside, all || last ? if_outside : after);
      position = after;
    }
  }

  /// Shows it if it is a solid between planes. False: it is none, and nothing is shown.
  bool show_convex(const Node& node) {
    constexpr std::uint32_t kMostSolids = 300; // the time grows with the square
    if (material_flags_ == nullptr || node.kind != Node::Kind::intersection || node.leaves > kMostSolids)
      return false;
    ConvexSolid solid;
    if (!cut(solid, node, *material_flags_)) return false;
    if (solid.is_surely_empty()) return true;
    std::optional<Object> object = solid.as_object(solid_bounds(node, kEverywhere));
    if (!object) return false;
    BuildWatch::look_at(to_.parts.size());
    CsgPart part;
    part.object = *std::move(object);
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&part.object.shape)) {
      part.bounds = bounds_of(**mesh, part.object.transform);
    } else {
      part.shape = place_shape(part.object);
      part.bounds = part.shape.bounds();
    }
    part.condition = kNoCondition;
    part.is_bounded = true;
    add_replaced(node, part.bounds);
    to_.parts.push_back(std::move(part));
    return true;
  }
  void add_replaced(const Node& node, const Aabb& bounds) {
    if (node.kind == Node::Kind::solid)
      to_.replaced.push_back(
          {node.shape, node.shape.is_bounded ? intersected(bounds, node.shape.bounds()) : bounds});
    for (const Node& child : node.children)
      add_replaced(child, bounds);
  }

  void show_solid(const Node& node, std::uint32_t condition, const Aabb& bounds) {
    if (node.shape.is_empty) return;
    BuildWatch::look_at(to_.parts.size());
    CsgPart part;
    part.object = node.object;
    part.shape = node.shape;
    part.condition = is_crossed_in_part(node, condition) ? add_crossed_mesh(node, condition) : condition;
    Aabb around = kEverywhere;
    if (node.mesh() != nullptr)
      around = node.mesh_bounds;
    else if (node.shape.is_bounded)
      around = node.shape.bounds();
    part.bounds = intersected(around, bounds);
    if (is_empty(part.bounds)) return;
    if (const Quadric* quadric = node.quadric())
      part.bounds = bounds_of_quadric(*quadric, node.object.transform, false, part.bounds);
    if (node.box) part.bounds = bounds_of_faces(*node.box, part.bounds);
    if (is_empty(part.bounds)) return;
    part.bounds = intersected(part.bounds, bounds_in_own_space(node, limits_));
    if (is_empty(part.bounds)) return;
    // Meshes that are too large are refused with their triangles.
    part.is_bounded = node.mesh() != nullptr || is_bounded(part.bounds);
    to_.parts.push_back(std::move(part));
  }

  /// Whether CSG gets to see a part of the crossings with a mesh only. What clips the mesh by itself comes
  /// before that.
  bool is_crossed_in_part(const Node& node, std::uint32_t condition) const {
    if (condition == kNoCondition || node.mesh() == nullptr || node.mesh()->has_inside() ||
        node.mesh()->triangles.size() < 2)
      return false;
    const bool clips_alone = to_.conditions[condition].next == kNoCondition && !limits_.empty() &&
                             limits_.back().intersection->is_clipped &&
                             &limits_.back().intersection->children.front() == &node;
    return !clips_alone;
  }
  /// The condition that a crossing is found, besides another one.
  std::uint32_t add_crossed_mesh(const Node& node, std::uint32_t condition) {
    SolidRecord solid{};
    solid.object.kind_and_flags = kCrossedMeshSolid;
    solid.object.extra = to_.crossed_meshes.of(*node.mesh());
    write_map(node.object.transform.inverse(), solid.object.geometry);
    CsgRecord record{};
    record.next = condition;
    record.steps = static_cast<std::uint32_t>(to_.steps.size());
    record.count = 1;
    to_.steps.push_back({static_cast<std::uint32_t>(to_.solids.size()), kCsgAccept, kCsgReject, 0});
    to_.solids.push_back(solid);
    to_.conditions.push_back(record);
    return static_cast<std::uint32_t>(to_.conditions.size()) - 1;
  }

  CsgParts& to_;
  const std::vector<std::uint32_t>* material_flags_; ///< null: solids stay as they are
  std::vector<Limit> limits_;                        ///< of what is being shown
};

} // namespace

bool CsgParts::contains(const Object& object) {
  return std::holds_alternative<std::shared_ptr<const Csg>>(object.shape) ||
         (object.clipped_by && !object.clipped_by->empty());
}

CsgParts::CsgParts(const Scene& scene, const Eye& eye,
                   const std::vector<std::shared_ptr<const Object>>& patterns, std::size_t convex,
                   const std::vector<std::uint32_t>& material_flags) {
  TreeBuilder builder(solids, meshes);
  Flattener patterns_flattener(*this, nullptr);
  for (const auto& object : patterns) {
    const Node tree = builder.build(*object, {});
    patterns_flattener.add_inside(tree);
    move_boundaries(tree, eye, solids);
  }
  // Most CSGs show a part at least.
  parts.reserve(
      static_cast<std::size_t>(std::count_if(scene.objects.begin(), scene.objects.end(), contains)));
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    BuildWatch::look_at(i);
    if (!contains(scene.objects[i])) continue;
    const std::size_t first_part = parts.size(), first_replaced = replaced.size();
    const std::size_t first_solid = solids.size(), first_step = steps.size();
    const Node tree = builder.build(scene.objects[i], {});
    Flattener(*this, i < convex ? &material_flags : nullptr).show(tree, kNoCondition, kEverywhere);
    // Nothing asks what is inside of solids that no program names.
    if (steps.size() == first_step)
      solids.resize(first_solid);
    else
      move_boundaries(tree, eye, solids);
    for (std::size_t part = first_part; part < parts.size(); ++part) {
      parts[part].whole = i;
      parts[part].object.interior = interior_or_own(parts[part].object.interior, scene, i);
      parts[part].object.is_hidden = scene.objects[i].is_hidden;
    }
    for (std::size_t surface = first_replaced; surface < replaced.size(); ++surface)
      replaced[surface].whole = i;
  }
}

} // namespace celltrace
