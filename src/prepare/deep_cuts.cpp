#include "prepare/deep_cuts.hpp"

#include "geometry/shape_geometry.hpp"
#include "prepare/csg_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>

namespace celltrace {

namespace {

/// Limit on comparisons of faces in a scene.
constexpr std::size_t kMostComparisons = most_of(PictureLimit::shallow_cuts);

/// A face of a shape in the scene. `end` numbers the faces of a box by axis, the lower face of each axis
/// first, and the ends of a cylinder or cone, the base first.
struct EndFace {
  Vec3 normal; ///< points outwards
  double distance;
  Vec3 point;
  std::size_t leaf;
  int end;
  bool is_of_box;
};

class DeepCuts {
public:
  explicit DeepCuts(const PassContext& context) : context_(context), eye_(context.eye) {}

  /// Returns the object with deeper cuts and thicker plates; nothing if it needs no change.
  std::optional<Object> changed(const Object& object) {
    if (!std::holds_alternative<std::shared_ptr<const Csg>>(object.shape)) return {};
    const bool may_be_thin = limits_parts(object, 0) && has_leaf(object, false, is_thin);
    if (!may_be_thin && !has_leaf(object, false, cuts)) return {};
    kept_.clear();
    cut_.clear();
    leaves_ = 0;
    const auto add = [this](const Object& leaf, const LeafPlace& place) {
      add_faces(leaf, place);
      ++leaves_;
    };
    visit_leaves(object, LeafPlace(), add);
    find_shallow();
    if (may_be_thin) find_thin();
    if (moves_.empty()) return {};
    leaves_ = 0;
    const auto deepen = [this](const Object& leaf, const LeafPlace& place) { return deeper(leaf, place); };
    return with_leaves_changed(object, LeafPlace(), deepen);
  }

private:
  struct Move {
    std::size_t leaf;
    int end;
    double way; ///< distance by which the end moves along the normal
    Vec3 normal;
  };

  /// Returns whether a leaf is subtracted and has ends, which may lie slightly beyond the object's ends.
  static bool cuts(const Object& leaf, bool inverse) {
    return inverse &&
           (std::holds_alternative<Box>(leaf.shape) || std::holds_alternative<Cylinder>(leaf.shape) ||
            std::holds_alternative<Cone>(leaf.shape));
  }

  /// Returns whether a leaf is a plate of the object, maybe so thin that no point is found inside of it.
  static bool is_thin(const Object& leaf, bool inverse) {
    constexpr double kThin = 1e-4;
    const auto* const box = std::get_if<Box>(&leaf.shape);
    if (box == nullptr || inverse) return false;
    const Vec3 size = glm::abs(box->corner[1] - box->corner[0]);
    return std::min({size.x, size.y, size.z}) < kThin * std::max({size.x, size.y, size.z});
  }
  /// Returns whether a CSG shows parts only where they are inside of other parts.
  static bool limits_parts(const Object& object, int depth) {
    const auto* const csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
    if (csg == nullptr || depth > kDeepestCsg) return false;
    using Operation = Csg::Operation;
    if ((*csg)->operation == Operation::intersection || (*csg)->operation == Operation::difference)
      return true;
    return std::any_of((*csg)->parts.begin(), (*csg)->parts.end(),
                       [depth](const Object& part) { return limits_parts(part, depth + 1); });
  }

  void add_face(const LeafPlace& place, int end, const Vec3& outward, const Vec3& point,
                bool is_of_box = false) {
    EndFace face{};
    face.is_of_box = is_of_box;
    face.normal = glm::normalize(place.transform.normal(outward));
    face.point = place.transform.point(point);
    face.distance = glm::dot(face.normal, face.point);
    face.leaf = leaves_;
    face.end = end;
    if (!std::isfinite(face.distance)) return;
    (place.inverse ? cut_ : kept_).push_back(face);
  }
  void add_ends(const LeafPlace& place, const Vec3& base, const Vec3& cap, bool has_base, bool has_cap) {
    const Vec3 along = cap - base;
    if (!(glm::dot(along, along) > 0)) return;
    if (has_base) add_face(place, 0, -along, base);
    if (has_cap) add_face(place, 1, along, cap);
  }
  void add_faces(const Object& leaf, const LeafPlace& place) {
    if (const auto* const box = std::get_if<Box>(&leaf.shape)) {
      for (int end = 0; end < 6; ++end) {
        Vec3 outward(0);
        outward[end / 2] = end % 2 != 0 ? 1 : -1;
        add_face(place, end, outward, box->corner[corner_of(*box, end)], true);
      }
    } else if (const auto* const cylinder = std::get_if<Cylinder>(&leaf.shape)) {
      if (!cylinder->open) add_ends(place, cylinder->base, cylinder->cap, true, true);
    } else if (const auto* const cone = std::get_if<Cone>(&leaf.shape)) {
      if (!cone->open) add_ends(place, cone->base, cone->cap, cone->base_radius != 0, cone->cap_radius != 0);
    } else if (const auto* const plane = std::get_if<Plane>(&leaf.shape)) {
      if (!place.inverse) add_face(place, 0, plane->normal, glm::normalize(plane->normal) * plane->distance);
    }
  }
  static int corner_of(const Box& box, int end) {
    const int axis = end / 2;
    return (box.corner[0][axis] > box.corner[1][axis]) != (end % 2 != 0);
  }

  /// Least depth of a cut as a share of size_at(), on which the precision of a face's points depends.
  static constexpr double kDeepEnough = 2e-6; // single precision has errors of up to a tenth of this
  double size_at(const Vec3& point) const {
    const Vec3 eye = eye_.start();
    return glm::length(eye) + glm::length(point) + glm::length(point - eye);
  }

  /// Thickens plates on the side away from the eye, so that objects on that side are inside of the plates.
  void find_thin() {
    for (std::size_t i = 0; i + 1 < kept_.size(); ++i) {
      const EndFace &a = kept_[i], &b = kept_[i + 1];
      if (a.leaf != b.leaf || a.end % 2 != 0 || b.end != a.end + 1 || !a.is_of_box) continue;
      const double thick = a.distance + b.distance, wanted = kDeepEnough * size_at(a.point);
      if (!(thick > 0 && thick < wanted)) continue;
      const bool is_seen = glm::dot(eye_.location(), a.normal) > a.distance;
      const EndFace& back = is_seen ? b : a;
      moves_.push_back({back.leaf, back.end, wanted - thick, back.normal});
    }
  }

  void find_shallow() {
    constexpr double kSameDirection = 1e-9, kSamePlane = 1e-11;
    moves_.clear();
    for (const EndFace& cut : cut_) {
      if (pairs_ > kMostComparisons) return context_.pass(PictureLimit::shallow_cuts);
      pairs_ += kept_.size();
      const double size = size_at(cut.point);
      double way = 0;
      for (const EndFace& kept : kept_) {
        const double beyond = cut.distance - kept.distance;
        const Vec3 turned = glm::abs(cut.normal - kept.normal);
        if (beyond > kSamePlane * size && beyond < kDeepEnough * size &&
            std::max({turned.x, turned.y, turned.z}) < kSameDirection)
          way = std::max(way, kDeepEnough * size - beyond);
      }
      if (way > 0) moves_.push_back({cut.leaf, cut.end, way, cut.normal});
    }
  }

  /// Returns the length by which a leaf has to grow along its axis `outward` so that its end moves by `move`.
  static double growth(const Move& move, const Vec3& outward, const LeafPlace& place) {
    return move.way / glm::dot(place.transform.direction(outward), move.normal);
  }
  std::optional<Object> deeper(const Object& leaf, const LeafPlace& place) {
    std::optional<Object> result;
    for (const Move& move : moves_) {
      if (move.leaf != leaves_) continue;
      if (!result) result = leaf;
      if (auto* const box = std::get_if<Box>(&result->shape)) {
        Vec3 outward(0);
        outward[move.end / 2] = move.end % 2 != 0 ? 1 : -1;
        box->corner[corner_of(*box, move.end)] += outward * growth(move, outward, place);
      } else if (auto* const cylinder = std::get_if<Cylinder>(&result->shape)) {
        Vec3& end = move.end != 0 ? cylinder->cap : cylinder->base;
        const Vec3 outward = glm::normalize(end - (move.end != 0 ? cylinder->base : cylinder->cap));
        end += outward * growth(move, outward, place);
      } else if (auto* const cone = std::get_if<Cone>(&result->shape)) {
        Vec3& end = move.end != 0 ? cone->cap : cone->base;
        double& radius = move.end != 0 ? cone->cap_radius : cone->base_radius;
        const Vec3 along = end - (move.end != 0 ? cone->base : cone->cap);
        const double other = move.end != 0 ? cone->base_radius : cone->cap_radius,
                     length = glm::length(along);
        const double longer = growth(move, along / length, place);
        end += along / length * longer;
        radius += (radius - other) * longer / length;
      }
    }
    ++leaves_;
    return result;
  }

  const PassContext& context_;
  const Eye& eye_;
  std::vector<EndFace> kept_, cut_;
  std::vector<Move> moves_;
  std::size_t leaves_ = 0, pairs_ = 0;
};

} // namespace

std::optional<Scene> deepen_cuts(const Scene& scene, const PassContext& context) {
  DeepCuts cuts(context);
  return with_objects_changed(scene, [&](const Object& object) { return cuts.changed(object); });
}

} // namespace celltrace
