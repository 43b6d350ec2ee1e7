#include "prepare/coplanar_faces.hpp"

#include "geometry/bounding_tree.hpp"
#include "geometry/object_extents.hpp"
#include "prepare/face_list.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>

namespace celltrace {

namespace {

constexpr std::size_t kMostObjects = most_of(PictureLimit::coplanar_objects);
/// Limit on overlapping pairs of faces; more pairs would take too long.
constexpr std::size_t kMostOverlaps = most_of(PictureLimit::coplanar_pairs);
/// Limit on steps by which faces of one plane are moved apart.
constexpr int kMostSteps = most_of(PictureLimit::coplanar_layers);
/// Number of steps that certainly move a face out of a solid on whose boundary the face was: solids are
/// slightly enlarged.
constexpr int kStepsOut = 3;

class CoplanarFaces {
public:
  /// Collects the faces of the first kMostObjects objects. `eye` and `start`, which belong to an Eye, are
  /// null if any face may be visible.
  CoplanarFaces(const Scene& scene, const PassContext& context, const Vec3* eye, const Vec3* start)
      : scene_(scene), context_(context), list_(scene, context.material_flags, eye, kMostObjects), eye_(eye),
        start_(start) {}

  /// Finds the steps of all faces; returns whether a face has to be moved.
  bool settle() {
    list_.for_each_plane([this](std::size_t first, std::size_t last) { settle(first, last); });
    return any_moves_;
  }
  /// Returns whether there are two faces that may have to be moved for some location of the eye.
  bool any_overlap() {
    bool any = false;
    list_.for_each_plane([&](std::size_t first, std::size_t last) {
      any = any || !list_.for_each_pair(first, last, [&](const Face& a, const Face& b) {
        return (a.is_inverse && b.is_inverse) || (a.is_round && b.is_round) ||
               !FaceList::overlap(a.extent, b.extent);
      });
    });
    return any;
  }

  /// Returns whether the picture depends, for some location of the eye, on which of two faces is visible. If
  /// there are too many pairs, only the first pairs are examined.
  bool any_matters() {
    bool any = false;
    list_.for_each_plane([&](std::size_t first, std::size_t last) {
      list_.for_each_pair(first, last, [&](const Face& a, const Face& b) {
        any = any || (may_differ(a, b) && FaceList::overlap(a.extent, b.extent));
        return !any;
      });
    });
    return any;
  }

  Scene moved() const {
    Scene scene = scene_;
    struct Sides {
      const Face* face[6] = {};
    };
    std::vector<Sides> sides(list_.solid_count());
    std::vector<bool> has_moves(scene.objects.size());
    for (const Face& face : list_.faces()) {
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
  /// Returns the vector by which a face is moved. It is longer than rounding errors, and too short to be
  /// seen.
  Vec3 way(const Face& face) const {
    constexpr double kStep = 5e-7;
    const Vec3& eye = *start_;
    Vec3 near(0);
    if (!face.extent.is_everywhere())
      for (int axis = 0; axis < 3; ++axis)
        near[axis] = std::clamp(eye[axis], face.extent.min[axis], face.extent.max[axis]);
    const double size = glm::length(eye) + std::abs(face.distance) + glm::length(near);
    return face.normal * (kStep * face.steps * size * (list_.is_seen_from_above(face) ? 1 : -1));
  }
  void move_side(Box& box, int side, const Transform& transform, const Face& face) const {
    const int axis = side / 2;
    Vec3 unit(0);
    unit[axis] = 1;
    const int corner = (box.corner[0][axis] > box.corner[1][axis]) != (side % 2 != 0);
    box.corner[corner][axis] += along(transform.direction(unit), face);
  }
  /// Moves an end of a cylinder or a cone.
  template <class Round>
  void move_side(Round& solid, int side, const Transform& transform, const Face& face) const {
    const Vec3 axis = solid.cap - solid.base;
    (side != 0 ? solid.cap : solid.base) += axis * along(transform.direction(axis), face);
  }
  /// Returns the distance along a direction, in lengths of the direction, to the face's new plane.
  double along(const Vec3& direction, const Face& face) const {
    return glm::dot(way(face), face.normal) / glm::dot(direction, face.normal);
  }

  /// Returns whether the picture depends on which of the two faces a ray hits. The inside of opaque objects
  /// is never visible. Ends of cylinders and cones are rounded differently from other faces, in POV-Ray too:
  /// they are only ordered if something transparent stands on an opaque face.
  bool can_differ(const Face& a, const Face& b) const {
    // Subtracted objects often share faces with the object that they are cut out of. Such faces stay, except
    // for the ground of a room.
    if (a.is_inverse && b.is_inverse) return false;
    if (a.is_inverse || b.is_inverse) {
      const Face &ground = a.is_inverse ? a : b, &other = a.is_inverse ? b : a;
      if (!list_.is_ground(ground) || list_.is_opaque(other) || list_.faces_camera(other)) return false;
    }
    if (a.is_round || b.is_round) return a.is_round != b.is_round && list_.is_ground(a.is_round ? b : a);
    if (are_merged(a, b)) return true;
    const bool are_opaque = list_.is_opaque(a) && list_.is_opaque(b);
    return !are_opaque || (a.faces_up == b.faces_up && a.material != b.material);
  }

  /// Returns whether the picture may depend, from some location, on which face is hit; can_differ() also uses
  /// the eye.
  bool may_differ(const Face& a, const Face& b) const {
    const bool are_opaque = list_.is_opaque(a) && list_.is_opaque(b);
    if (a.is_inverse || b.is_inverse) return a.is_inverse != b.is_inverse && !are_opaque;
    if (a.is_round || b.is_round) return a.is_round != b.is_round;
    return are_merged(a, b) || !are_opaque || (a.faces_up == b.faces_up && a.material != b.material);
  }

  /// The order of two faces in one plane: `near` has to be nearer to the eye than `far`, by `steps`.
  struct Order {
    Face* near;
    Face* far;
    int steps = 1;
  };

  /// The operation of a CSG that has two faces in different parts, and the indices of these parts.
  struct Fork {
    Csg::Operation operation;
    std::size_t part[2];
  };
  std::optional<Fork> fork_of(const Face& a, const Face& b) const {
    if (a.object != b.object || a.path == 0 || b.path == 0) return std::nullopt;
    const CsgPath &of_a = list_.path_of(a), &of_b = list_.path_of(b);
    std::size_t level = 0;
    while (level < std::min(of_a.size(), of_b.size()) && of_a[level].part == of_b[level].part)
      ++level;
    if (level == std::min(of_a.size(), of_b.size())) return std::nullopt;
    return Fork{of_a[level].csg->operation, {of_a[level].part, of_b[level].part}};
  }
  /// Returns whether the faces belong to parts of a merge, so that each is inside of the other part.
  /// Depending on rounding, POV-Ray shows both or neither face at a point, which makes specks or a hole.
  bool are_merged(const Face& a, const Face& b) const {
    const std::optional<Fork> fork = fork_of(a, b);
    return fork && fork->operation == Csg::Operation::merge;
  }

  /// Returns the order of two faces of one object if both look the same way and belong to parts of an
  /// intersection or a merge. POV-Ray shows the last part of an intersection: faces of other parts are moved
  /// out of that part. One face of a merge has to be visible, with the others behind it.
  std::optional<Order> order_of_parts(Face& a, Face& b) const {
    const std::optional<Fork> fork = fork_of(a, b);
    if (!fork || a.faces_up != b.faces_up) return std::nullopt;
    if (fork->operation != Csg::Operation::intersection && !are_merged(a, b)) return std::nullopt;
    Face& out = fork->part[0] < fork->part[1] ? a : b;
    Face& in = &out == &a ? b : a;
    if (a.faces_up == list_.is_seen_from_above(a)) return Order{&out, &in, kStepsOut};
    return Order{&in, &out, kStepsOut};
  }

  /// Returns the order of faces of two objects: the face that POV-Ray shows is nearer.
  Order order_of_objects(Face& a, Face& b) {
    if (a.is_round) return {&b, &a};
    if (b.is_round) return {&a, &b};
    if (is_seen(a, b)) return {&a, &b};
    return {&b, &a};
  }

  /// Moves the faces [first, last) of one plane apart.
  void settle(std::size_t first, std::size_t last) {
    std::vector<Order> orders;
    const bool all = list_.for_each_pair(first, last, [&](Face& a, Face& b) {
      if (overlaps_ > kMostOverlaps) return false;
      if (!can_differ(a, b) || !FaceList::overlap(a.extent, b.extent)) return true;
      ++overlaps_;
      const std::optional<Order> order = a.object == b.object ? order_of_parts(a, b) : order_of_objects(a, b);
      if (order) orders.push_back(*order);
      return true;
    });
    if (!all) return pass_pairs(first, last);
    if (orders.empty()) return;
    any_moves_ = true;
    if (stack(orders)) return;
    // The orders contain a cycle: which face is visible depends on the ray, so that no order is right
    // everywhere. The objects' ranks in the tree are right for most rays.
    for (Order& order : orders)
      if (tree_ && tree_->rank(order.far->object) < tree_->rank(order.near->object))
        std::swap(order.near, order.far);
    if (stack(orders)) return;
    for (std::size_t i = first; i < last; ++i)
      list_.faces()[i].steps = 0;
    context_.pass(PictureLimit::coplanar_layers);
  }
  /// Reports that the faces [first, last) of one plane have too many pairs, unless all faces look the same.
  void pass_pairs(std::size_t first, std::size_t last) {
    if (overlaps_ > kMostOverlaps) return context_.pass(PictureLimit::coplanar_pairs);
    const Face& one = list_.faces()[first];
    for (std::size_t i = first; i < last; ++i)
      if (const Face& other = list_.faces()[i]; may_differ(one, other))
        return context_.pass(PictureLimit::coplanar_comparisons);
  }

  /// Sets the steps of the faces. Returns false if a face would need too many steps.
  static bool stack(const std::vector<Order>& orders) {
    for (const Order& order : orders)
      order.near->steps = order.far->steps = 0;
    // Without cycles, each round settles the faces with one more step.
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

  /// Returns whether POV-Ray shows `a` where two faces overlap.
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
  const PassContext& context_;
  FaceList list_;
  const Vec3* eye_;
  const Vec3* start_;
  std::size_t overlaps_ = 0;
  std::optional<BoundingTree> tree_;
  bool any_moves_ = false;
};

} // namespace

std::optional<Scene> move_faces_apart(const Scene& scene, const PassContext& context) {
  const auto faces_from_anywhere = [&] { return CoplanarFaces(scene, context, nullptr, nullptr); };
  if (scene.objects.size() > kMostObjects) {
    if (faces_from_anywhere().any_matters()) context.pass(PictureLimit::coplanar_objects);
    return std::nullopt;
  }
  const Eye& eye = context.eye;
  if (eye.may_move() && !faces_from_anywhere().any_overlap()) return std::nullopt;
  CoplanarFaces faces(scene, context, &eye.location(), &eye.start());
  if (!faces.settle()) return std::nullopt;
  return faces.moved();
}

} // namespace celltrace
