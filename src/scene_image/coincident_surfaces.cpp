#include "scene_image/coincident_surfaces.hpp"

#include "geometry/bounding_tree.hpp"
#include "geometry/object_extents.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/object_order.hpp"
#include "scene_image/shapes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

namespace celltrace {

namespace {

/// Limit on pairs of surfaces to examine; more pairs would take too long.
constexpr std::size_t kMostSurfacePairs = most_of(PictureLimit::coincident_pairs);
/// Limit on surfaces that are examined to find out whether the order of objects matters at all.
constexpr std::size_t kMostSurfacesWithoutOrder = 8192;

/// A surface of an object, and the region in which the object may show it.
struct PlacedSurface {
  std::uint32_t kind;
  std::array<float, 14> numbers; ///< geometry and parameters
  std::size_t object;
  Index material; ///< kNoIndex if the surface has no material of its own
  kernel::Aabb bounds;

  bool is_same_as(const PlacedSurface& other) const { return kind == other.kind && numbers == other.numbers; }
};

class PlacedSurfaces {
public:
  /// Collects the surfaces of the objects, but at most the first `most` surfaces.
  PlacedSurfaces(const Scene& scene, std::size_t count, const CsgParts& parts, std::size_t most)
      : most_(most) {
    for (const CsgPart& part : parts.parts)
      if (part.whole < count && !is_mesh(part.object))
        add(part.shape, part.whole, part.object.material, part.bounds);
    for (const CsgSurface& surface : parts.replaced)
      add(surface.shape, surface.whole, kNoIndex, surface.bounds);
    for (std::size_t i = 0; i < count && surfaces_.size() < most_; ++i) {
      const Object& object = scene.objects[i];
      if (CsgParts::contains(object) || is_mesh(object) || !has_bounds(object)) continue;
      const PlacedShape shape = place_shape(object);
      if (!shape.is_empty) add(shape, i, object.material, shape.bounds());
    }
    std::stable_sort(surfaces_.begin(), surfaces_.end(), [](const PlacedSurface& a, const PlacedSurface& b) {
      return a.kind != b.kind ? a.kind < b.kind : a.numbers < b.numbers;
    });
  }

  /// Calls `visit(a, b, middle)` for each pair of coinciding surfaces of different objects, until a call
  /// returns false. `middle` is the middle of the region in which both surfaces may be seen. Returns false if
  /// a call returned false, or if there are too many pairs.
  template <class Visit> bool for_each_pair(const Visit& visit) const {
    std::size_t pairs = 0;
    for (std::size_t first = 0, last; first < surfaces_.size(); first = last) {
      for (last = first + 1; last < surfaces_.size() && surfaces_[last].is_same_as(surfaces_[first]);)
        ++last;
      for (std::size_t a = first; a < last; ++a)
        for (std::size_t b = a + 1; b < last; ++b) {
          ProgressMonitor::check_cancelled(pairs);
          if (++pairs > kMostSurfacePairs) return false;
          if (surfaces_[a].object == surfaces_[b].object) continue;
          const std::optional<Vec3> middle = middle_of(surfaces_[a].bounds, surfaces_[b].bounds);
          if (middle && !visit(surfaces_[a], surfaces_[b], *middle)) return false;
        }
    }
    return true;
  }

private:
  /// Returns the middle of the intersection of two boxes; nothing if the boxes have no point in common.
  static std::optional<Vec3> middle_of(const kernel::Aabb& a, const kernel::Aabb& b) {
    const kernel::Aabb both = intersected(a, b);
    Vec3 middle;
    for (int i = 0; i < 3; ++i) {
      if (both.min[i] > both.max[i]) return std::nullopt;
      middle[i] = 0.5 * (static_cast<double>(both.min[i]) + static_cast<double>(both.max[i]));
    }
    return middle;
  }
  static bool is_mesh(const Object& object) {
    return std::holds_alternative<std::shared_ptr<const Mesh>>(object.shape);
  }
  void add(const PlacedShape& shape, std::size_t object, Index material, const kernel::Aabb& bounds) {
    if (surfaces_.size() == most_) return;
    PlacedSurface& surface = surfaces_.emplace_back();
    surface.kind = shape.kind_and_flags;
    std::copy(shape.geometry, shape.geometry + 12, surface.numbers.begin());
    std::copy(shape.parameters, shape.parameters + 2, surface.numbers.begin() + 12);
    surface.object = object;
    surface.material = material;
    surface.bounds = bounds;
  }

  const std::size_t most_;
  std::vector<PlacedSurface> surfaces_;
};

/// Returns whether surfaces of different materials coincide, among the pairs that the limit allows.
bool any_differ(const PlacedSurfaces& surfaces) {
  bool any = false;
  surfaces.for_each_pair([&](const PlacedSurface& a, const PlacedSurface& b, const Vec3&) {
    any = a.material != b.material || a.material == kNoIndex;
    return !any;
  });
  return any;
}

/// Returns the objects of `order`, each after the objects that `before` lists for it. If requirements form a
/// cycle, one of them is ignored.
std::vector<std::size_t> sorted(const std::vector<std::size_t>& order,
                                std::vector<std::vector<std::size_t>> before) {
  std::vector<std::size_t> result;
  std::vector<bool> is_visited(before.size());
  std::vector<std::size_t> path;
  const auto enter = [&](std::size_t object) {
    if (!is_visited[object]) path.push_back(object);
    is_visited[object] = true;
  };
  for (const std::size_t object : order) {
    enter(object);
    while (!path.empty()) {
      std::vector<std::size_t>& open = before[path.back()];
      if (open.empty()) {
        result.push_back(path.back());
        path.pop_back();
      } else {
        const std::size_t next = open.back();
        open.pop_back();
        enter(next);
      }
    }
  }
  return result;
}

} // namespace

std::vector<std::size_t> order_of_tests(const Scene& scene, const Eye& eye, std::size_t count,
                                        const CsgParts& parts, PassedLimits& limits) {
  std::vector<std::size_t> order;
  for (const bool are_csgs : {false, true})
    for (std::size_t i = 0; i < count; ++i)
      if (CsgParts::contains(scene.objects[i]) == are_csgs) order.push_back(i);
  std::vector<std::vector<std::size_t>> before(count);
  if (has_order_of_tests(count, parts)) {
    std::optional<BoundingTree> tree;
    const PlacedSurfaces surfaces(scene, count, parts, std::numeric_limits<std::size_t>::max());
    const auto visit = [&](const PlacedSurface& a, const PlacedSurface& b, const Vec3& middle) {
      if (!tree) {
        std::vector<Extent> extents;
        for (std::size_t i = 0; i < count; ++i)
          extents.push_back(extent_of(scene.objects[i], Transform()));
        tree.emplace(extents, scene.lights.size());
      }
      const Vec3 from = eye.location();
      const bool a_first = tree->tests_first(a.object, b.object, {from, middle - from});
      before[(a_first ? b : a).object].push_back((a_first ? a : b).object);
      return true;
    };
    if (!surfaces.for_each_pair(visit)) limits.insert(PictureLimit::coincident_pairs);
  } else if (!parts.parts.empty() &&
             any_differ(PlacedSurfaces(scene, count, parts, kMostSurfacesWithoutOrder))) {
    limits.insert(PictureLimit::coincident_objects);
  }
  return sorted(order, std::move(before));
}

bool has_order_of_tests(std::size_t count, const CsgParts& parts) {
  static_assert(kMinObjectsToOrder == most_of(PictureLimit::coincident_objects) + 1);
  return !parts.parts.empty() && count + parts.parts.size() < kMinObjectsToOrder;
}

} // namespace celltrace
