#include "prepare/coplanar_faces.hpp"

#include "geometry/bounding_tree.hpp"
#include "geometry/object_extents.hpp"
#include "kernel/records.hpp"
#include "scene/build_watch.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace celltrace {

namespace {

constexpr std::size_t kMostObjects = 8192;
constexpr std::size_t kMostPairs = 1 << 20, kMostOverlaps = 1 << 16; ///< beyond these nobody waits for more
constexpr int kMostSteps = 32; ///< that faces of one plane are moved apart by
/// Steps that surely take a face out of a solid whose boundary it was on: that is a little larger than it is.
constexpr int kStepsOut = 3;

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

/// Turns the normal, which points out, the way that Face says.
void turn(Face& face) {
  constexpr double kNone = 1e-9;
  int axis = 0;
  while (axis < 2 && std::abs(face.normal[axis]) < kNone)
    ++axis;
  face.looks_up = face.normal[axis] > 0;
  if (face.looks_up) return;
  face.normal = -face.normal;
  face.distance = -face.distance;
}

class CoplanarFaces {
public:
  /// `eye` and `start`, which are of an Eye, are null for faces of which any may be seen.
  CoplanarFaces(const Scene& scene, std::span<const std::uint32_t> material_flags, const Vec3* eye,
                const Vec3* start)
      : scene_(scene), material_flags_(material_flags), eye_(eye), start_(start) {
    std::size_t solids = 0;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const Object& object = scene.objects[i];
      if (const auto* const plane = std::get_if<Plane>(&object.shape)) add_plane(i, *plane);
      const auto visit = [&](const auto& solid, const Transform& transform, Index material,
                             const CsgPath& path, int inversions) {
        if (!object.is_hidden && inversions < 2)
          add(i, solids, solid, transform, material, path, inversions == 1);
        ++solids;
      };
      visit_solids(object, visit);
    }
    solid_count_ = solids;
  }

  /// Whether any has to be moved.
  bool settle() {
    for_each_plane([this](std::size_t first, std::size_t last) { settle(first, last); });
    return any_moves_;
  }
  /// Whether there are two that may have to be, wherever the eye is.
  bool any_overlap() {
    bool any = false;
    for_each_plane([&](std::size_t first, std::size_t last) {
      any = any || !for_each_pair(first, last, [&](const Face& a, const Face& b) {
              return (a.is_inverse && b.is_inverse) || (a.is_round && b.is_round) ||
                     !overlap(a.extent, b.extent);
            });
    });
    return any;
  }

  Scene moved() const {
    Scene scene = scene_;
    struct Sides {
      const Face* face[6] = {};
    };
    std::vector<Sides> sides(solid_count_);
    std::vector<bool> has_moves(scene.objects.size());
    for (const Face& face : faces_) {
      if (face.steps == 0) continue;
      has_moves[face.object] = true;
      if (face.solid != Face::kPlane)
        sides[face.solid].face[face.side] = &face;
      else
        scene.objects[face.object].transform =
            scene.objects[face.object].transform.then(Transform::translate(way(face)));
    }
    std::size_t number = 0;
    const auto move = [&](auto& solid, const Transform& transform, Index, const CsgPath&, int) {
      for (int side = 0; side < 6; ++side)
        if (const Face* const face = sides[number].face[side]) move_side(solid, side, transform, *face);
      ++number;
    };
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      if (has_moves[i]) {
        visit_solids(scene.objects[i], move);
      } else {
        const auto pass = [&](const auto&, const Transform&, Index, const CsgPath&, int) { ++number; };
        visit_solids(std::as_const(scene.objects[i]), pass);
      }
    }
    return scene;
  }

private:
  /// How far a face is moved: farther than where rounding may put it, and much less than can be seen.
  Vec3 way(const Face& face) const {
    constexpr double kStep = 5e-7;
    const Vec3& eye = *start_;
    Vec3 near(0);
    if (!face.extent.is_everywhere())
      for (int axis = 0; axis < 3; ++axis)
        near[axis] = std::clamp(eye[axis], face.extent.min[axis], face.extent.max[axis]);
    const double size = glm::length(eye) + std::abs(face.distance) + glm::length(near);
    return face.normal * (kStep * face.steps * size * (is_seen_from_above(face) ? 1 : -1));
  }
  void move_side(Box& box, int side, const Transform& transform, const Face& face) const {
    const int axis = side / 2;
    Vec3 unit(0);
    unit[axis] = 1;
    const int corner = (box.corner[0][axis] > box.corner[1][axis]) != (side % 2 != 0);
    box.corner[corner][axis] += along(transform.direction(unit), face);
  }
  /// Of a cylinder or a cone.
  template <class Round>
  void move_side(Round& solid, int side, const Transform& transform, const Face& face) const {
    const Vec3 axis = solid.cap - solid.base;
    (side != 0 ? solid.cap : solid.base) += axis * along(transform.direction(axis), face);
  }
  /// How far to go in a direction, in lengths of it, to where the face is moved.
  double along(const Vec3& direction, const Face& face) const {
    return glm::dot(way(face), face.normal) / glm::dot(direction, face.normal);
  }
  bool looks_at_eye(const Face& face) const { return face.looks_up == is_seen_from_above(face); }
  /// Whether the eye is where the normal points.
  bool is_seen_from_above(const Face& face) const { return glm::dot(*eye_, face.normal) > face.distance; }

  void add_plane(std::size_t object, const Plane& plane) {
    Face face{};
    const Transform& transform = scene_.objects[object].transform;
    face.normal = glm::normalize(transform.normal(plane.normal));
    face.distance = glm::dot(face.normal, transform.point(glm::normalize(plane.normal) * plane.distance));
    turn(face);
    face.extent = Extent::everywhere();
    face.material = scene_.objects[object].material;
    face.object = object;
    face.solid = Face::kPlane;
    if (is_usable(face)) faces_.push_back(face);
  }

  /// Of an inverse box the inside is seen, as that of a room which is cut out of something; and of one that
  /// the eye is in.
  void add(std::size_t object, std::size_t number, const Box& box, const Transform& transform, Index material,
           const CsgPath& path, bool is_inverse) {
    const bool has_order = !path.empty() && !is_inverse; // among its CSG's faces
    if (has_order) paths_.push_back(path);
    const Vec3 low = glm::min(box.corner[0], box.corner[1]), high = glm::max(box.corner[0], box.corner[1]);
    const bool is_seen_inside =
        is_inverse || (eye_ != nullptr && path.empty() && holds_eye(low, high, transform));
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2;
      const double at = (side % 2 != 0 ? high : low)[axis];
      Vec3 unit(0);
      unit[axis] = 1;
      Vec3 corners[4];
      for (int corner = 0; corner < 4; ++corner) {
        corners[corner][axis] = at;
        corners[corner][(axis + 1) % 3] = (corner & 1 ? high : low)[(axis + 1) % 3];
        corners[corner][(axis + 2) % 3] = (corner & 2 ? high : low)[(axis + 2) % 3];
      }
      Face face = face_of(corners, unit * (side % 2 != 0 ? 1.0 : -1.0), transform);
      face.material = material;
      face.is_inverse = is_inverse;
      face.looks_up = face.looks_up != is_seen_inside;
      // Those that look away are seen through something, or in mirrors: where many are, time is worth more.
      if (eye_ != nullptr && is_opaque(face) && !looks_at_eye(face)) continue;
      face.object = object;
      face.solid = number;
      face.side = side;
      face.path = has_order ? static_cast<std::uint32_t>(paths_.size()) : 0;
      if (is_usable(face)) faces_.push_back(face);
    }
  }
  bool holds_eye(const Vec3& low, const Vec3& high, const Transform& transform) const {
    const Vec3 eye = transform.inverse().point(*eye_);
    return glm::all(glm::lessThanEqual(low, eye)) && glm::all(glm::lessThanEqual(eye, high));
  }

  /// Of cylinders and cones the ends that are seen through them.
  template <class Round>
  void add(std::size_t object, std::size_t number, const Round& solid, const Transform& transform,
           Index material, const CsgPath&, bool is_inverse) {
    if (solid.open || is_inverse) return;
    const Vec3 axis = solid.cap - solid.base;
    int least = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(axis[i]) < std::abs(axis[least])) least = i;
    Vec3 unit(0);
    unit[least] = 1;
    const Vec3 across = glm::normalize(glm::cross(axis, unit)), up = glm::normalize(glm::cross(axis, across));
    for (int side = 0; side < 2; ++side) {
      const double radius = radius_at(solid, side);
      const Vec3 middle = side != 0 ? solid.cap : solid.base;
      Vec3 corners[4];
      for (int corner = 0; corner < 4; ++corner)
        corners[corner] =
            middle + (across * (corner & 1 ? 1.0 : -1.0) + up * (corner & 2 ? 1.0 : -1.0)) * radius;
      Face face = face_of(corners, side != 0 ? axis : -axis, transform);
      face.material = material;
      if (is_opaque(face) || (eye_ != nullptr && looks_at_eye(face))) continue;
      face.object = object;
      face.solid = number;
      face.side = side;
      face.is_round = true;
      if (is_usable(face)) faces_.push_back(face);
    }
  }
  static double radius_at(const Cylinder& cylinder, int) { return cylinder.radius; }
  static double radius_at(const Cone& cone, int side) {
    return side != 0 ? cone.cap_radius : cone.base_radius;
  }

  /// A face as its solid has it, `outward` being normal to it.
  static Face face_of(const Vec3 (&corners)[4], const Vec3& outward, const Transform& transform) {
    Face face{};
    face.normal = glm::normalize(transform.normal(outward));
    for (const Vec3& corner : corners) {
      const Vec3 place = transform.point(corner);
      face.extent = &corner == corners ? Extent{place, place} : face.extent.joined({place, place});
      face.distance = glm::dot(face.normal, place);
    }
    turn(face);
    return face;
  }

  /// Not where a transformation is singular, or a box as wide as numbers reach: it is refused elsewhere.
  static bool is_usable(const Face& face) {
    constexpr double kFarthest = 1e12;
    const Vec3 reach = glm::max(glm::abs(face.extent.min), glm::abs(face.extent.max));
    return glm::dot(face.normal, face.normal) < 2 && std::abs(face.distance) < kFarthest &&
           reach.x < kFarthest && reach.y < kFarthest && reach.z < kFarthest;
  }

  static bool are_parallel(const Face& a, const Face& b) {
    constexpr double kSame = 1e-9;
    const Vec3 difference = glm::abs(a.normal - b.normal);
    return std::max({difference.x, difference.y, difference.z}) < kSame;
  }
  static bool are_in_one_plane(const Face& a, const Face& b) {
    constexpr double kSame = 1e-11;
    return are_parallel(a, b) && std::abs(a.distance - b.distance) <= kSame * (1 + std::abs(a.distance));
  }

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

  /// So that those of one plane are neighbours.
  void sort() {
    struct Key {
      std::int32_t normal[3]; ///< rounded
      std::uint32_t face;
      double distance;
    };
    std::vector<Key> keys;
    keys.reserve(faces_.size());
    for (const Face& face : faces_) {
      const auto rounded = [&](int axis) {
        return static_cast<std::int32_t>(std::floor(face.normal[axis] * 1e6 + 0.25));
      };
      const auto number = static_cast<std::uint32_t>(keys.size());
      keys.push_back({{rounded(0), rounded(1), rounded(2)}, number, face.distance});
    }
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
      return std::tie(a.normal[0], a.normal[1], a.normal[2], a.distance) <
             std::tie(b.normal[0], b.normal[1], b.normal[2], b.distance);
    });
    std::vector<Face> sorted;
    sorted.reserve(faces_.size());
    for (const Key& key : keys)
      sorted.push_back(faces_[key.face]);
    faces_ = std::move(sorted);
  }

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
  /// Whether it shows which one of the two rays hit. From inside of what is opaque nothing is seen. Ends of
  /// cylinders and cones are rounded otherwise than faces, by POV-Ray, too: it is settled only where
  /// something transparent stands on what is opaque.
  bool can_differ(const Face& a, const Face& b) const {
    // What is cut out often has faces with what it is cut out of: they stay, but as the ground of a room.
    if (a.is_inverse && b.is_inverse) return false;
    if (a.is_inverse || b.is_inverse) {
      const Face &ground = a.is_inverse ? a : b, &other = a.is_inverse ? b : a;
      if (!is_ground(ground) || is_opaque(other) || looks_at_eye(other)) return false;
    }
    if (a.is_round || b.is_round) return a.is_round != b.is_round && is_ground(a.is_round ? b : a);
    if (are_merged(a, b)) return true;
    const bool are_opaque = is_opaque(a) && is_opaque(b);
    return !are_opaque || (a.looks_up == b.looks_up && a.material != b.material);
  }

  /// Two faces of one plane: the first one belongs nearer to the eye, by so many steps.
  struct Order {
    Face* near;
    Face* far;
    int steps = 1;
  };

  /// Where two faces of one object are in different parts that are joined or cut: the parts, or nothing.
  struct Fork {
    Csg::Operation operation;
    std::size_t part[2];
  };
  std::optional<Fork> fork_of(const Face& a, const Face& b) const {
    if (a.object != b.object || a.path == 0 || b.path == 0) return std::nullopt;
    const CsgPath &of_a = paths_[a.path - 1], &of_b = paths_[b.path - 1];
    std::size_t level = 0;
    while (level < std::min(of_a.size(), of_b.size()) && of_a[level].part == of_b[level].part)
      ++level;
    if (level == std::min(of_a.size(), of_b.size())) return std::nullopt;
    return Fork{of_a[level].csg->operation, {of_a[level].part, of_b[level].part}};
  }
  /// Whether they are faces of parts of a merge, each of which is in the other part. As rounding has it
  /// POV-Ray shows both or neither at a point: there are specks, or a hole.
  bool are_merged(const Face& a, const Face& b) const {
    const std::optional<Fork> fork = fork_of(a, b);
    return fork && fork->operation == Csg::Operation::merge;
  }

  /// Orders two faces of one object, if they look the same way and are of parts of an intersection or a
  /// merge. POV-Ray shows the last part of an intersection: the other faces are moved out, where they are in
  /// no other part. One face of a merge is to be seen, and the others are behind it.
  std::optional<Order> order_of_parts(Face& a, Face& b) const {
    const std::optional<Fork> fork = fork_of(a, b);
    if (!fork || a.looks_up != b.looks_up) return std::nullopt;
    if (fork->operation != Csg::Operation::intersection && !are_merged(a, b)) return std::nullopt;
    Face& out = fork->part[0] < fork->part[1] ? a : b;
    Face& in = &out == &a ? b : a;
    if (a.looks_up == is_seen_from_above(a)) return Order{&out, &in, kStepsOut};
    return Order{&in, &out, kStepsOut};
  }

  /// Of faces of two objects: the one that POV-Ray shows is nearer.
  Order order_of_objects(Face& a, Face& b) {
    if (a.is_round) return {&b, &a};
    if (b.is_round) return {&a, &b};
    if (is_seen(a, b)) return {&a, &b};
    return {&b, &a};
  }

  /// Moves faces [first, last) of one plane apart.
  void settle(std::size_t first, std::size_t last) {
    std::vector<Order> orders;
    const bool all = for_each_pair(first, last, [&](Face& a, Face& b) {
      if (overlaps_ > kMostOverlaps) return false;
      if (!can_differ(a, b) || !overlap(a.extent, b.extent)) return true;
      ++overlaps_;
      const std::optional<Order> order = a.object == b.object ? order_of_parts(a, b) : order_of_objects(a, b);
      if (order) orders.push_back(*order);
      return true;
    });
    if (!all || orders.empty()) return;
    any_moves_ = true;
    if (stack(orders)) return;
    // What is seen depends on the ray, and no order of all faces is right everywhere.
    for (Order& order : orders)
      if (tree_ && tree_->rank(order.far->object) < tree_->rank(order.near->object))
        std::swap(order.near, order.far);
    if (stack(orders)) return;
    for (std::size_t i = first; i < last; ++i)
      faces_[i].steps = 0;
  }

  /// Gives the faces their steps. False if these would be too many.
  static bool stack(const std::vector<Order>& orders) {
    for (const Order& order : orders)
      order.near->steps = order.far->steps = 0;
    // Without circles each round settles one step more.
    for (int round = 0; round <= kMostSteps + 1; ++round) {
      bool has_changed = false;
      for (const Order& order : orders) {
        if (order.near->steps >= order.far->steps + order.steps) continue;
        order.near->steps = order.far->steps + order.steps;
        if (order.near->steps > kMostSteps) return false;
        has_changed = true;
      }
      if (!has_changed) return true;
    }
    return false;
  }

  /// Whether POV-Ray shows `a` where the two overlap.
  bool is_seen(const Face& a, const Face& b) {
    if (!tree_) {
      std::vector<Extent> extents;
      for (const Object& object : scene_.objects)
        extents.push_back(extent_of(object, Transform()));
      tree_.emplace(extents, scene_.lights.size());
    }
    const Extent both = a.extent.common(b.extent);
    const Vec3& eye = *eye_;
    const Vec3 middle = both.is_everywhere() ? eye + a.normal : (both.min + both.max) * 0.5;
    return tree_->tests_first(a.object, b.object, {eye, middle - eye});
  }

  const Scene& scene_;
  std::span<const std::uint32_t> material_flags_;
  const Vec3* eye_;
  const Vec3* start_;
  std::vector<Face> faces_;
  std::vector<CsgPath> paths_; ///< of boxes in CSGs
  std::size_t solid_count_ = 0, pairs_ = 0, overlaps_ = 0;
  std::optional<BoundingTree> tree_;
  bool any_moves_ = false;
};

} // namespace

std::optional<Scene> move_faces_apart(const Scene& scene, const PassContext& context) {
  if (scene.objects.size() > kMostObjects) return std::nullopt;
  const auto& [eye, material_flags] = context;
  if (eye.may_move() && !CoplanarFaces(scene, material_flags, nullptr, nullptr).any_overlap())
    return std::nullopt;
  CoplanarFaces faces(scene, material_flags, &eye.location(), &eye.start());
  if (!faces.settle()) return std::nullopt;
  return faces.moved();
}

} // namespace celltrace
