// Faces of solids by the planes that they are in.
#pragma once

#include "celltrace/picture_limit.hpp"
#include "celltrace/scene.hpp"
#include "geometry/extent.hpp"
#include "records/object.hpp"
#include "scene/build_watch.hpp"

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

/// The parts of an object's CSG that a solid is in, from the whole down.
struct PathStep {
  const Csg* csg;
  std::size_t part;
};
using CsgPath = std::vector<PathStep>;

/// In a plane whose normal points to where the first of its coordinates grows that are not 0.
struct Face {
  Vec3 normal;
  double distance; ///< of the plane from the origin
  Extent extent;
  std::size_t object;
  std::size_t solid; ///< kPlane: the object is a plane
  int side;        ///< of a box: axis * 2, and 1 for the one of larger coordinates; of others: 1 for the cap
  bool is_round;   ///< an end of a cylinder or a cone
  bool is_inverse; ///< of a box that is cut out of something
  bool looks_up;   ///< its outside is where the normal points
  Index material;
  std::uint32_t path = 0; ///< its number
  int steps = 0;          ///< to move it, toward the eye

  static constexpr std::size_t kPlane = ~std::size_t{0};
};

/// Calls `visit(solid, transform, material, path, inversions)` for the boxes, cylinders and cones of an
/// object, which may be changed: those in its CSG, too. `inversions`: how often it is turned inside out, or
/// cut out of something. CSGs are copied if they may be.
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

/// The faces of a scene's boxes, cylinders, cones and planes that may be seen in one plane with others.
class FaceList {
public:
  /// `scene` and `material_flags` stay as they are as long as this lives. `eye` is null for faces of which
  /// any may be seen. Objects behind the first `most` are left out.
  FaceList(const Scene& scene, std::span<const std::uint32_t> material_flags, const Vec3* eye,
           std::size_t most);

  std::vector<Face>& faces() { return faces_; }
  const std::vector<Face>& faces() const { return faces_; }
  /// The parts that a face's box is in; the face has a path.
  const CsgPath& path_of(const Face& face) const { return paths_[face.path - 1]; }
  /// Boxes, cylinders and cones, numbered as visit_solids() comes to them.
  std::size_t solid_count() const { return solid_count_; }

  /// Whether two faces of one plane share more than edges.
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
  /// Whether something can be seen to stand on it.
  bool is_ground(const Face& face) const { return is_opaque(face) && looks_at_eye(face); }
  bool is_opaque(const Face& face) const {
    return (material_flags_[face.material] & kernel::object_flag::opaque) != 0;
  }
  bool looks_at_eye(const Face& face) const { return face.looks_up == is_seen_from_above(face); }
  /// Whether the eye is where the normal points.
  bool is_seen_from_above(const Face& face) const { return glm::dot(*eye_, face.normal) > face.distance; }

  /// Calls `visit(first, last)` for the faces [first, last) of each plane that has more than one.
  template <class Visit> void for_each_plane(Visit visit) {
    sort();
    for (std::size_t first = 0, last = 1; first < faces_.size(); first = last++) {
      while (last < faces_.size() && are_in_one_plane(faces_[last - 1], faces_[last]))
        ++last;
      if (last - first > 1) visit(first, last);
    }
  }
  /// Calls `visit(a, b)` for pairs of [first, last) whose extents meet along x, until it returns false. False
  /// then, and if there are too many.
  template <class Visit> bool for_each_pair(std::size_t first, std::size_t last, Visit visit) {
    std::sort(faces_.begin() + static_cast<std::ptrdiff_t>(first),
              faces_.begin() + static_cast<std::ptrdiff_t>(last),
              [](const Face& a, const Face& b) { return a.extent.min.x < b.extent.min.x; });
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t k = i + 1; k < last && faces_[k].extent.min.x <= faces_[i].extent.max.x; ++k) {
        BuildWatch::look_at(pairs_);
        if (++pairs_ > kMostPairs || !visit(faces_[i], faces_[k])) return false;
      }
    }
    return true;
  }

private:
  void add_plane(std::size_t object, const Plane& plane);
  /// Adds the faces of a box. The inside is seen of an inverse one, as that of a room which is cut out of
  /// something, and of one that the eye is in.
  void add(std::size_t object, std::size_t number, const Box& box, const Transform& transform, Index material,
           const CsgPath& path, bool is_inverse);
  bool holds_eye(const Vec3& low, const Vec3& high, const Transform& transform) const;
  /// Adds the ends of a cylinder or cone that are seen through it.
  template <class Round>
  void add(std::size_t object, std::size_t number, const Round& solid, const Transform& transform,
           Index material, const CsgPath&, bool is_inverse);
  /// Makes neighbours of the faces of one plane.
  void sort();
  static bool are_in_one_plane(const Face& a, const Face& b);

  /// Beyond these nobody waits for more.
  static constexpr std::size_t kMostPairs = most_of(PictureLimit::coplanar_comparisons);

  const Scene& scene_;
  std::span<const std::uint32_t> material_flags_;
  const Vec3* eye_;
  std::vector<Face> faces_;
  std::vector<CsgPath> paths_; ///< of boxes in CSGs
  std::size_t solid_count_ = 0, pairs_ = 0;
};

} // namespace celltrace
