#include "pov/bounds_check.hpp"

#include <algorithm>
#include <cmath>

#include "pov/object_queries.hpp"
#include "pov/patterns.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

constexpr int kRaysAlongSide = 5;
constexpr std::uint64_t kRays = 6 * kRaysAlongSide * kRaysAlongSide;
/// Limit on shape tests for all objects of a scene, which take a few milliseconds.
constexpr std::uint64_t kMostTests = 20'000;
/// A point counts as outside of the bounds if it is still outside at this share of its distance from their
/// middle.
constexpr double kMargin = 0.99;
/// The size of the region in which an object without an extent is tested, as a multiple of its bounds.
constexpr double kReach = 3;
/// Extents that are larger count as infinite.
constexpr double kEndless = 1e9;

/// Returns whether POV-Ray tests the bounds of such an object, and rays can be traced to it.
bool can_be_tried(const ObjectDefinition& object) {
  if (object.missing || object.light() || is_singular(object.transform)) return false;
  if (const auto* compound = std::get_if<std::shared_ptr<const Compound>>(&object.shape))
    return std::all_of((*compound)->parts.begin(), (*compound)->parts.end(),
                       [](const ObjectPtr& part) { return can_be_tried(*part); });
  const auto* shape = std::get_if<Shape>(&object.shape);
  return shape != nullptr && !std::holds_alternative<Disc>(*shape) &&
         !std::holds_alternative<Torus>(*shape) &&
         !std::holds_alternative<std::shared_ptr<const Polygon>>(*shape);
}

Vec3 middle_of(const Extent& extent) {
  return (extent.min + extent.max) * 0.5;
}

/// Returns the region in which an object is tested.
Extent tried_extent(const Extent& own, const Extent& bounds) {
  Extent tried = own;
  const Vec3 middle = middle_of(bounds), reach = (bounds.max - bounds.min) * (kReach / 2);
  for (int axis = 0; axis < 3; ++axis) {
    if (own.min[axis] < -kEndless) tried.min[axis] = middle[axis] - reach[axis];
    if (own.max[axis] > kEndless) tried.max[axis] = middle[axis] + reach[axis];
  }
  return tried;
}

/// Calls `visit(point)` with the first hit of each ray along the axes, until it returns true.
template <class Visit>
bool any_surface_point(Session& session, const ObjectDefinition& object, const Extent& extent,
                       const Location& where, const Visit& visit) {
  const Vec3 size = extent.max - extent.min;
  for (int axis = 0; axis < 3; ++axis)
    for (const int way : {1, -1})
      for (int ray = 0; ray < kRaysAlongSide * kRaysAlongSide; ++ray) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        Vec3 origin, direction(0);
        origin[axis] = way > 0 ? extent.min[axis] - size[axis] - 1 : extent.max[axis] + size[axis] + 1;
        origin[u] = extent.min[u] + size[u] * (ray % kRaysAlongSide + 0.5) / kRaysAlongSide;
        origin[v] = extent.min[v] + size[v] * (ray / kRaysAlongSide + 0.5) / kRaysAlongSide;
        direction[axis] = way;
        const auto hit = trace(session, object, origin, direction, where);
        if (hit && visit(hit->point)) return true;
      }
  return false;
}

} // namespace

bool reaches_out_of_bounds(Session& session, const ObjectDefinition& object, const Location& where) {
  if (object.bounded_by.empty() || !can_be_tried(object)) return false;
  session.bounds_tests += kRays * object.size;
  if (session.bounds_tests > kMostTests) return false;
  ObjectDefinition unbounded = object;
  unbounded.bounded_by.clear();
  const Extent own = extent_of(session, unbounded, where);
  for (const Limit& limit : object.bounded_by) {
    ObjectDefinition bounds = *limit.object;
    bounds.apply(limit.transform);
    if (bounds.inverse || !can_be_tried(bounds)) continue;
    const Extent extent = extent_of(session, bounds, where);
    if (extent.is_everywhere()) continue;
    const Vec3 middle = middle_of(extent);
    const auto is_out = [&](const Vec3& point) {
      return !contains(session, bounds, middle + (point - middle) * kMargin, where);
    };
    if (any_surface_point(session, unbounded, tried_extent(own, extent), where, is_out)) return true;
  }
  return false;
}

} // namespace celltrace::pov
