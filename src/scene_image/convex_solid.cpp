#include "scene_image/convex_solid.hpp"

#include "scene_image/polytope.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace celltrace {

namespace {

/// Relative size below which a solid counts as flat, or a distance as zero: relative to a box's longest side,
/// or to the size of the space around a solid.
constexpr double kFlat = 1e-6;
/// Unit normals count as equal if the length of their difference is at most this.
constexpr double kParallel = 1e-9;

/// Returns whether two objects are the same to rays, except for their materials.
bool are_alike(const Object& a, const Object& b) {
  return a.no_shadow == b.no_shadow && a.no_image == b.no_image && a.no_reflection == b.no_reflection &&
         a.light_group == b.light_group && a.is_lit_through == b.is_lit_through && a.interior == b.interior;
}

/// The triangles of convex faces, which share the vertices at their common corners.
class MeshOfFaces {
public:
  explicit MeshOfFaces(double tolerance) : tolerance_(tolerance) {}

  void add(const std::vector<Vec3>& corners, const Vec3& normal, Index material) {
    std::vector<Index> around;
    for (const Vec3& corner : corners) {
      const Index vertex = vertex_at(corner);
      if (around.empty() || (vertex != around.back() && vertex != around.front())) around.push_back(vertex);
    }
    // The normal of a flat triangle is opposite to the cross product of its edges.
    if (around.size() >= 3 && glm::dot(area(around), normal) > 0) std::reverse(around.begin(), around.end());
    halve(around, material);
  }
  Mesh take() { return std::move(mesh_); }

private:
  /// Appends the triangles of a face. Cuts the face in half at each step, instead of cutting off one triangle
  /// after the other, so that not all triangles are thin.
  void halve(const std::vector<Index>& around, Index material) {
    if (around.size() < 3) return;
    if (around.size() == 3) {
      mesh_.triangles.push_back({{around[0], around[1], around[2]},
                                 {kNoIndex, kNoIndex, kNoIndex},
                                 {material, material, material}});
      return;
    }
    const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
    halve({around.begin(), middle + 1}, material);
    std::vector<Index> rest(middle, around.end());
    rest.push_back(around.front());
    halve(rest, material);
  }
  Index vertex_at(const Vec3& corner) {
    const auto same = std::find_if(corners_.begin(), corners_.end(), [&](const Vec3& other) {
      const Vec3 between = corner - other;
      return glm::dot(between, between) <= tolerance_ * tolerance_;
    });
    const auto index = static_cast<Index>(same - corners_.begin());
    if (same == corners_.end()) {
      corners_.push_back(corner);
      mesh_.vertices.push_back(Vec3f(corner));
    }
    return index;
  }
  Vec3 area(const std::vector<Index>& around) const {
    Vec3 sum(0);
    for (std::size_t i = 2; i < around.size(); ++i)
      sum += glm::cross(corners_[around[i - 1]] - corners_[around[0]],
                        corners_[around[i]] - corners_[around[0]]);
    return sum;
  }

  double tolerance_;
  std::vector<Vec3> corners_;
  Mesh mesh_;
};

} // namespace

bool ConvexSolid::cut(const Object& object) {
  if (half_spaces_.empty()) first_ = object;
  if (!are_alike(first_, object)) return false;
  const auto add = [&](const Vec3& normal, const Vec3& at) {
    const Vec3 outward = glm::normalize(object.transform.normal(normal)) * (object.inverse ? -1.0 : 1.0);
    const double offset = glm::dot(outward, object.transform.point(at));
    half_spaces_.push_back({outward, offset, object.material});
    return std::isfinite(offset);
  };
  if (const auto* plane = std::get_if<Plane>(&object.shape)) {
    const Vec3 normal = glm::normalize(plane->normal);
    return add(normal, normal * plane->distance);
  }
  const auto* box = std::get_if<Box>(&object.shape);
  if (box == nullptr || object.inverse) return false;
  const Vec3 low = glm::min(box->corner[0], box->corner[1]), high = glm::max(box->corner[0], box->corner[1]);
  const Vec3 size = high - low;
  if (!(std::min({size.x, size.y, size.z}) > kFlat * std::max({size.x, size.y, size.z}))) return false;
  const std::size_t first = half_spaces_.size();
  half_spaces_.reserve(first + 8);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 normal(0);
    normal[axis] = 1;
    if (!add(normal, high) || !add(-normal, low)) return false;
  }
  if (box_) return true;
  WholeBox& whole = box_.emplace();
  whole.first = first;
  whole.reach = 0;
  for (int i = 0; i < 8; ++i) {
    whole.corners[i] = object.transform.point(
        {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z});
    const Vec3 away = glm::abs(whole.corners[i] - whole.corners[0]);
    whole.reach = std::max({whole.reach, away.x, away.y, away.z});
  }
  return true;
}

/// Returns on which side of another half-space's plane the corners of box_ are.
ConvexSolid::Side ConvexSolid::side_of(const HalfSpace& half_space, double tolerance) const {
  double least = std::numeric_limits<double>::max(), most = -least;
  for (const Vec3& corner : box_->corners) {
    const double height = glm::dot(half_space.normal, corner) - half_space.offset;
    least = std::min(least, height);
    most = std::max(most, height);
  }
  return most < -tolerance ? Side::inside : least > tolerance ? Side::outside : Side::cut;
}

bool ConvexSolid::is_surely_empty() const {
  return box_ && std::any_of(half_spaces_.begin(), half_spaces_.end(), [this](const HalfSpace& half_space) {
           return side_of(half_space, kFlat * box_->reach) == Side::outside;
         });
}

/// Returns the faces of box_ in reverse order, or nothing if another half-space cuts this box, or if this box
/// is flat compared with a space of this size.
std::vector<ConvexSolid::HalfSpace> ConvexSolid::faces_of_whole_box(double size) const {
  if (!box_) return {};
  const double tolerance = kFlat * std::max(size, box_->reach);
  const auto first = half_spaces_.begin() + static_cast<std::ptrdiff_t>(box_->first), end = first + 6;
  const auto is_beside = [&](const HalfSpace& half_space) {
    return side_of(half_space, tolerance) == Side::inside;
  };
  if (!std::all_of(half_spaces_.begin(), first, is_beside) ||
      !std::all_of(end, half_spaces_.end(), is_beside))
    return {};
  const auto is_wide = [&](const HalfSpace& face) {
    return std::any_of(std::begin(box_->corners), std::end(box_->corners), [&](const Vec3& corner) {
      return face.offset - glm::dot(face.normal, corner) > kFlat * size;
    });
  };
  if (!std::all_of(first, end, is_wide)) return {};
  return {std::make_reverse_iterator(end), std::make_reverse_iterator(first)};
}

std::optional<Object> ConvexSolid::as_object(const kernel::Aabb& around) const {
  // Starts with a box larger than `around`, so that planes exactly on the faces of `around` do cut it.
  kernel::Aabb start = around;
  double size = 0;
  for (int i = 0; i < 3; ++i)
    size = std::max(size, double{around.max[i]} - double{around.min[i]});
  if (!(size < Polytope::kReach)) return {};
  for (int i = 0; i < 3; ++i) {
    start.min[i] -= static_cast<float>(size);
    start.max[i] += static_cast<float>(size);
  }
  const auto box_of_faces = [&](const std::vector<HalfSpace>& shown) -> std::optional<Object> {
    const std::optional<Transform> box = box_between(shown);
    if (!box) return {};
    Object object = first_;
    object.inverse = false;
    object.shape = Box{{Vec3(0), Vec3(1)}};
    object.transform = *box;
    object.material = shown.front().material;
    return object;
  };
  std::vector<HalfSpace> shown = faces_of_whole_box(size);
  if (std::optional<Object> whole = box_of_faces(shown)) return whole;
  shown.clear();
  const double tolerance = 0.1 * kFlat * size;
  Polytope polytope(start);
  for (std::size_t i = half_spaces_.size(); i-- > 0;)
    polytope.cut_exactly(half_spaces_[i].normal, half_spaces_[i].offset, tolerance, i);

  for (const Polytope::Face& face : polytope.faces()) {
    if (face.source == Polytope::kBox) return {};
    shown.push_back(half_spaces_[face.source]);
  }
  // A flat solid would show both of its sides at one place.
  const auto is_flat_below = [&](const HalfSpace& face) {
    return std::none_of(polytope.faces().begin(), polytope.faces().end(), [&](const Polytope::Face& other) {
      return std::any_of(other.corners.begin(), other.corners.end(), [&](const Vec3& corner) {
        return face.offset - glm::dot(face.normal, corner) > kFlat * size;
      });
    });
  };
  if (shown.size() < 4 || std::any_of(shown.begin(), shown.end(), is_flat_below)) return {};
  if (std::optional<Object> box = box_of_faces(shown)) return box;
  MeshOfFaces faces(tolerance);
  for (std::size_t i = 0; i < shown.size(); ++i)
    faces.add(polytope.faces()[i].corners, shown[i].normal, shown[i].material);
  Mesh mesh = faces.take();
  if (mesh.triangles.empty()) return {};
  Object object = first_;
  object.inverse = false;
  object.shape = std::make_shared<const Mesh>(std::move(mesh));
  object.transform = Transform();
  return object;
}

/// Returns the transformation of the box from 0 to 1 to the box with these faces; nothing if the faces are
/// not parallel in pairs, or have several materials.
std::optional<Transform> ConvexSolid::box_between(const std::vector<HalfSpace>& faces) {
  if (faces.size() != 6) return {};
  Vec3 normal[3];
  double low[3], high[3];
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i].material != faces[0].material) return {};
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      if (glm::distance(faces[i].normal, -faces[j].normal) > kParallel) continue;
      if (pairs == 3) return {};
      normal[pairs] = faces[i].normal;
      high[pairs] = faces[i].offset;
      low[pairs++] = -faces[j].offset;
    }
  }
  if (pairs != 3) return {};
  Transform box;
  box.rows[3] = Vec3(0);
  for (int i = 0; i < 3; ++i) {
    // The axis lies along the edge that the other two planes share.
    const Vec3 edge = glm::cross(normal[(i + 1) % 3], normal[(i + 2) % 3]);
    const Vec3 unit = edge / glm::dot(edge, normal[i]);
    box.rows[i] = unit * (high[i] - low[i]);
    box.rows[3] += unit * low[i];
  }
  return box;
}

} // namespace celltrace
