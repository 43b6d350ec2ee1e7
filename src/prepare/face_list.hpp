// Faces of solids, grouped by plane.
#pragma once

#include "celltrace/picture_limit.hpp"
#include "celltrace/scene.hpp"
#include "geometry/extent.hpp"
#include "records/object.hpp"
#include "scene/progress_monitor.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>

namespace celltrace {

/// A step on the path from an object's CSG down to a solid: a CSG, and the index of its part.
struct PathStep {
  const Csg* csg;
  std::size_t part;
};
using CsgPath = std::vector<PathStep>;

/// A face in a plane. The first nonzero coordinate of the plane's normal is positive.
struct Face {
  Vec3 normal;
  double distance; ///< distance of the plane from the origin, along the normal
  Extent extent;
  std::size_t object;
  std::size_t solid; ///< index of the solid; kPlane if the object is a plane
  int side; ///< box: axis * 2, plus 1 for the larger coordinate; other solid: 0 for the base, 1 for the cap
  bool is_round;   ///< true for an end of a cylinder or a cone
  bool is_inverse; ///< true for a face of a subtracted box
  bool faces_up;   ///< true if the solid's outside is in the direction of the normal
  Index material;
  std::uint32_t path = 0; ///< number of the path, from 1 on; 0 if there is no path
  int steps = 0;          ///< number of steps by which the face is moved toward the eye

  static constexpr std::size_t kPlane = ~std::size_t{0};
};

/// Calls `visit(solid, transform, material, path, inversions)` for the boxes, cylinders and cones of an
/// object, including those in its CSG. `inversions` tells how often a solid is inverted or subtracted. If
/// `object` is not const, copies its CSGs, so that `visit` may change solids.
template <class AnyObject, class Visit>
void visit_solids(AnyObject& object, const Transform& around, int inversions, CsgPath& path, Visit& visit) {
  const Transform transform = object.transform.then(around);
  inversions += object.inverse ? 1 : 0;
  if (auto* const box = std::get_if<Box>(&object.shape))
    return visit(*box, transform, object.material, path, inversions);
  if (auto* const cylinder = std::get_if<Cylinder>(&object.shape))
    return visit(*cylinder, transform, object.material, path, inversions);
  if (auto* const cone = std::get_if<Cone>(&object.shape))
    return visit(*cone, transform, object.material, path, inversions);
  auto* const shared = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  if (shared == nullptr || (*shared)->parts.empty()) return;
  const auto visit_parts = [&](auto& csg) {
    for (std::size_t i = 0; i < csg.parts.size(); ++i) {
      const bool is_cut = csg.operation == Csg::Operation::difference && i > 0;
      path.push_back({&csg, i});
      visit_solids(csg.parts[i], transform, inversions + (is_cut ? 1 : 0), path, visit);
      path.pop_back();
    }
  };
  if constexpr (std::is_const_v<AnyObject>) {
    visit_parts(**shared);
  } else {
    auto copy = std::make_shared<Csg>(**shared);
    visit_parts(*copy);
    *shared = std::move(copy);
  }
}

template <class AnyObject, class Visit> void visit_solids(AnyObject& object, Visit& visit) {
  CsgPath path;
  visit_solids(object, Transform(), 0, path, visit);
}

/// The faces of a scene's boxes, cylinders, cones and planes that may be visible where several lie in one
/// plane.
class FaceList {
public:
  /// Collects faces of the first `most` objects. `scene` and `material_flags` must not change while this
  /// object lives. `eye` is null if any face may be visible.
  FaceList(const Scene& scene, std::span<const std::uint32_t> material_flags, const Vec3* eye,
           std::size_t most);

  std::vector<Face>& faces() { return faces_; }
  const std::vector<Face>& faces() const { return faces_; }
  /// Returns the path to a face's box; face.path must not be 0.
  const CsgPath& path_of(const Face& face) const { return paths_[face.path - 1]; }
  /// Returns the number of boxes, cylinders and cones. Solids are numbered in the order of visit_solids().
  std::size_t solid_count() const { return solid_count_; }

  /// Returns whether the extents of two faces of one plane overlap in more than edges.
  static bool overlap(const Extent& a, const Extent& b) {
    int wide = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double both = std::min(a.max[axis], b.max[axis]) - std::max(a.min[axis], b.min[axis]);
      const double size = std::min(a.max[axis] - a.min[axis], b.max[axis] - b.min[axis]);
      if (both < -1e-9 * (1 + std::abs(a.min[axis]))) return false;
      if (both > 1e-6 * size && both > 0) ++wide;
    }
    return wide >= 2;
  }
  /// Returns whether the eye can see that an object stands on the face.
  bool is_ground(const Face& face) const { return is_opaque(face) && faces_camera(face); }
  bool is_opaque(const Face& face) const {
    return (material_flags_[face.material] & kernel::object_flag::opaque) != 0;
  }
  bool faces_camera(const Face& face) const { return face.faces_up == is_seen_from_above(face); }
  /// Returns whether the eye is on the side of the normal.
  bool is_seen_from_above(const Face& face) const { return glm::dot(*eye_, face.normal) > face.distance; }

  /// Calls `visit(first, last)` for each plane with several faces, which are [first, last).
  template <class Visit> void for_each_plane(Visit visit) {
    sort();
    for (std::size_t first = 0, last = 1; first < faces_.size(); first = last++) {
      while (last < faces_.size() && are_in_one_plane(faces_[last - 1], faces_[last]))
        ++last;
      if (last - first > 1) visit(first, last);
    }
  }
  /// Calls `visit(a, b)` for pairs of [first, last) whose extents meet along x, until a call returns false.
  /// Returns false if a call returned false, or if there are too many pairs.
  template <class Visit> bool for_each_pair(std::size_t first, std::size_t last, Visit visit) {
    std::sort(faces_.begin() + static_cast<std::ptrdiff_t>(first),
              faces_.begin() + static_cast<std::ptrdiff_t>(last),
              [](const Face& a, const Face& b) { return a.extent.min.x < b.extent.min.x; });
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t k = i + 1; k < last && faces_[k].extent.min.x <= faces_[i].extent.max.x; ++k) {
        ProgressMonitor::check_cancelled(pairs_);
        if (++pairs_ > kMostPairs || !visit(faces_[i], faces_[k])) return false;
      }
    }
    return true;
  }

private:
  void add_plane(std::size_t object, const Plane& plane);
  /// Adds the faces of a box. The inside is visible if the box is inverse, such as a room that is subtracted
  /// from an object, or if the eye is in the box.
  void add(std::size_t object, std::size_t number, const Box& box, const Transform& transform, Index material,
           const CsgPath& path, bool is_inverse);
  bool holds_eye(const Vec3& low, const Vec3& high, const Transform& transform) const;
  /// Adds the visible ends of a cylinder or cone.
  template <class Round>
  void add(std::size_t object, std::size_t number, const Round& solid, const Transform& transform,
           Index material, const CsgPath&, bool is_inverse);
  /// Sorts the faces so that the faces of one plane are neighbours.
  void sort();
  static bool are_in_one_plane(const Face& a, const Face& b);

  /// Limit on pairs of faces; more pairs would take too long.
  static constexpr std::size_t kMostPairs = most_of(PictureLimit::coplanar_comparisons);

  const Scene& scene_;
  std::span<const std::uint32_t> material_flags_;
  const Vec3* eye_;
  std::vector<Face> faces_;
  std::vector<CsgPath> paths_; ///< paths to boxes in CSGs
  std::size_t solid_count_ = 0, pairs_ = 0;
};

} // namespace celltrace
