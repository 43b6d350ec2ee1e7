#include "scene_image/csg_tree_bounds.hpp"

#include "geometry/extent.hpp"
#include "kernel/accel/object_bounds.hpp"
#include "scene_image/box_bounds.hpp"
#include "scene_image/csg_bounds.hpp"
#include "scene_image/quadric_bounds.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace celltrace::csg {

using namespace kernel;

namespace {

/// Limit on planes by which a polytope is cut, since the time grows with the square of their number; further
/// planes are ignored.
constexpr std::size_t kMostPlanes = 1000;

/// Returns the half-space of a plane that is at right angles to an axis; kEverywhere for any other plane.
Aabb half_space(const PlacedShape& plane, bool inverse) {
  Aabb box = kEverywhere;
  const float* n = plane.geometry + 8;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(n[(i + 1) % 3]) > 1e-6f || std::abs(n[(i + 2) % 3]) > 1e-6f) continue;
    // The half-space is n x + d < 0.
    const float at = -n[3] / n[i];
    if ((n[i] > 0) != inverse)
      box.max[i] = at + slack_at(at);
    else
      box.min[i] = at - slack_at(at);
  }
  return box;
}

/// Returns slightly enlarged bounds of a box after a transformation.
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

/// Returns the shape of a solid that is no mesh, in the space to which `space` transforms the world, or in
/// the world if `space` is null.
PlacedShape placed_in(const Transform* space, const Node& node) {
  if (space == nullptr) return node.shape;
  Object object = node.object;
  object.transform = object.transform.then(*space);
  return place_shape(object);
}

/// Returns whether a transformation turns an axis in a direction that is not along an axis.
bool turns_axes(const Transform& transform) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 row = glm::abs(transform.rows[i]);
    if (row.x + row.y + row.z > (1 + 1e-6) * std::max({row.x, row.y, row.z})) return true;
  }
  return false;
}

} // namespace

Polytope HalfSpaces::cut_out_of(const Aabb& box) const {
  Polytope polytope(box);
  for (const Node* plane : planes_) {
    const float* n = plane->shape.geometry + 8;
    const double sign = plane->inverse ? -1 : 1;
    polytope.cut(sign * Vec3(n[0], n[1], n[2]), -sign * n[3], plane->record);
  }
  return polytope;
}

void HalfSpaces::collect(const Node& intersection) {
  for (const Node& child : intersection.children) {
    if (child.kind == Node::Kind::intersection) collect(child);
    if (!is_plane(child) || planes_.size() == kMostPlanes) continue;
    planes_.push_back(&child);
    const float* n = child.shape.geometry + 8;
    has_slanted_ = has_slanted_ || (n[0] != 0) + (n[1] != 0) + (n[2] != 0) > 1;
  }
}

Aabb solid_bounds(const Node& node, const Aabb& within, const Transform* space) {
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
    // A disc has a half-space as its inside, so that the disc's bounds are only those of its surface.
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

Aabb bounds_in_own_space(const Node& node, const std::vector<Limit>& limits) {
  if (node.mesh() != nullptr || node.shape.is_bounded || !turns_axes(node.object.transform))
    return kEverywhere;
  constexpr std::uint32_t kMostSolids = 100; // limits the cost for scenes with many shapes
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

} // namespace celltrace::csg
