#include "scene_image/csg_parts.hpp"

#include "scene/progress_monitor.hpp"
#include "scene_image/box_bounds.hpp"
#include "scene_image/convex_solid.hpp"
#include "scene_image/csg_bounds.hpp"
#include "scene_image/csg_tree.hpp"
#include "scene_image/csg_tree_bounds.hpp"
#include "scene_image/interior_records.hpp"
#include "scene_image/object_records.hpp"
#include "scene_image/polytope.hpp"
#include "scene_image/quadric_bounds.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace celltrace {

using namespace csg;
using namespace kernel;

namespace {

/// Cuts a solid by all solids of a node. Returns false if the result is not convex, or if a material needs
/// more than a point on a surface, so that triangles cannot have it.
bool cut(ConvexSolid& solid, const Node& node, const std::vector<std::uint32_t>& material_flags) {
  if (!node.shows || node.is_clipped) return false;
  if (node.kind == Node::Kind::solid)
    return !node.shape.is_empty && is_of_points(material_flags[node.object.material]) &&
           solid.cut(node.object);
  return node.kind == Node::Kind::intersection &&
         std::all_of(node.children.begin(), node.children.end(),
                     [&](const Node& child) { return cut(solid, child, material_flags); });
}

/// Appends the visible surfaces of a tree to the tables.
class Flattener {
public:
  /// Collects surfaces into `to`. Turns solids between planes into boxes or meshes if `material_flags` is not
  /// null.
  Flattener(CsgParts& to, const std::vector<std::uint32_t>* material_flags)
      : to_(to), material_flags_(material_flags) {}

  /// Adds a condition that is true inside of the solid that a tree describes.
  void add_inside(const Node& tree) {
    CsgRecord record{};
    record.next = kNoCondition;
    record.steps = static_cast<std::uint32_t>(to_.steps.size());
    compile(tree, 0, kCsgAccept, kCsgReject);
    record.count = static_cast<std::uint32_t>(to_.steps.size()) - record.steps;
    to_.conditions.push_back(record);
  }

  /// Adds the surfaces of `node`. These exist only where the condition is true and inside of `bounds`.
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
        // A child without an inside is visible where the point is in all other children.
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
  /// Adds the surfaces of `node` in the reverse order of its parts. Where surfaces coincide the kernel shows
  /// the surface of the first part, but POV-Ray shows the last one it finds: it collects crossings with the
  /// parts of an intersection, a merge or a clipped union from the last part on.
  void show_reversed(const Node& node, std::uint32_t condition, const Aabb& bounds) {
    const std::size_t first = to_.parts.size();
    show(node, condition, bounds);
    reverse_from(first);
  }
  void reverse_from(std::size_t first) {
    std::reverse(to_.parts.begin() + static_cast<std::ptrdiff_t>(first), to_.parts.end());
  }

  /// Compiles the program for a node's children; the condition of each child skips the steps of this child. A
  /// point must be in all other children of an intersection, and in none of a merge.
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
  /// Compiles the test of a node: continues at step `if_inside` if a point is in the node, else at
  /// `if_outside`.
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

  /// Shows a node as a box or mesh if it is a solid between planes. Returns false, and shows nothing, if it
  /// is not such a solid.
  bool show_convex(const Node& node) {
    constexpr std::uint32_t kMostSolids = 300; // the time grows with the square
    if (material_flags_ == nullptr || node.kind != Node::Kind::intersection || node.leaves > kMostSolids)
      return false;
    ConvexSolid solid;
    if (!cut(solid, node, *material_flags_)) return false;
    if (solid.is_surely_empty()) return true;
    std::optional<Object> object = solid.as_object(solid_bounds(node, kEverywhere));
    if (!object) return false;
    ProgressMonitor::check_cancelled(to_.parts.size());
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
    ProgressMonitor::check_cancelled(to_.parts.size());
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
    // Bounds of a mesh always count as finite. If they are too large, writing the mesh's triangles throws
    // InputError.
    part.is_bounded = node.mesh() != nullptr || is_bounded(part.bounds);
    to_.parts.push_back(std::move(part));
  }

  /// Returns whether CSG uses only some of the crossings with a mesh. Returns false if an object clips only
  /// the mesh: POV-Ray clips before it selects crossings.
  bool is_crossed_in_part(const Node& node, std::uint32_t condition) const {
    if (condition == kNoCondition || node.mesh() == nullptr || node.mesh()->has_inside() ||
        node.mesh()->triangles.size() < 2)
      return false;
    const bool clips_alone = to_.conditions[condition].next == kNoCondition && !limits_.empty() &&
                             limits_.back().intersection->is_clipped &&
                             &limits_.back().intersection->children.front() == &node;
    return !clips_alone;
  }
  /// Returns a condition that is true where `condition` is and POV-Ray finds the crossing with the mesh.
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
  const std::vector<std::uint32_t>* material_flags_; ///< if null, solids between planes stay as they are
  std::vector<Limit> limits_;                        ///< intersections around the node that is being shown
};

} // namespace

namespace {

bool is_made_of_data(const SolidRecord& solid) {
  return Primitives::is_made_of_data(solid.object.kind_and_flags & object_flag::kind_mask);
}

} // namespace

bool CsgParts::contains(const Object& object) {
  return std::holds_alternative<std::shared_ptr<const Csg>>(object.shape) ||
         (object.clipped_by && !object.clipped_by->empty());
}

CsgParts::CsgParts(const Scene& scene, const Eye& eye,
                   const std::vector<std::shared_ptr<const Object>>& patterns, std::size_t convex,
                   const std::vector<std::uint32_t>& material_flags) {
  Flattener patterns_flattener(*this, nullptr);
  for (const auto& object : patterns) {
    const Node tree = build_tree(*object, solids, meshes, shape_data);
    if (std::any_of(solids.begin(), solids.end(), is_made_of_data))
      throw InputError("the object of a pattern contains a polynomial, prism, lathe, sor or blob, which patterns do "
                       "not support");
    patterns_flattener.add_inside(tree);
    add_boundaries(tree, boundaries);
  }
  // Most CSGs show at least one part.
  parts.reserve(
      static_cast<std::size_t>(std::count_if(scene.objects.begin(), scene.objects.end(), contains)));
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    ProgressMonitor::check_cancelled(i);
    if (!contains(scene.objects[i])) continue;
    const std::size_t first_part = parts.size(), first_replaced = replaced.size();
    const std::size_t first_solid = solids.size(), first_step = steps.size();
    const Node tree = build_tree(scene.objects[i], solids, meshes, shape_data);
    Flattener(*this, i < convex ? &material_flags : nullptr).show(tree, kNoCondition, kEverywhere);
    // If there are no steps, the solids are never tested.
    if (steps.size() == first_step)
      solids.resize(first_solid);
    else
      add_boundaries(tree, boundaries);
    for (std::size_t part = first_part; part < parts.size(); ++part) {
      parts[part].whole = i;
      parts[part].object.interior = interior_or_own(parts[part].object.interior, scene, i);
      parts[part].object.is_hidden = scene.objects[i].is_hidden;
    }
    for (std::size_t surface = first_replaced; surface < replaced.size(); ++surface)
      replaced[surface].whole = i;
  }
  for (const SolidBoundary& boundary : boundaries)
    boundary.write(eye, solids.data());
}

} // namespace celltrace
