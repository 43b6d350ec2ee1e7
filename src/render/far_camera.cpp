#include "render/far_camera.hpp"

#include "kernel/accel/object_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

/// Half the size of the part of the scene that a camera sees, in multiples of its vectors right and up: the
/// size at the camera, and the growth for each length of `direction` ahead.
struct ViewExtent {
  double across = 0, across_growth = 0, up = 0, up_growth = 0;
};

/// Returns the extent of a camera's view; nothing if the picture may go all around.
std::optional<ViewExtent> view_extent_of(const Camera& camera) {
  constexpr double kRadiansPerDegree = std::numbers::pi / 180, kWidest = 0.5;
  const double right = glm::length(camera.right), up = glm::length(camera.up);
  const double angle = camera.angle * kRadiansPerDegree / 2, tangent = std::tan(angle);
  using Kind = Camera::Kind;
  if (camera.kind == Kind::perspective) return ViewExtent{0, 0.5, 0, 0.5};
  if (camera.kind == Kind::orthographic) return ViewExtent{0.5, 0, 0.5, 0};
  if (!(angle < kWidest)) return std::nullopt;
  // All kinds but the two above have axes of unit length.
  switch (camera.kind) {
  case Kind::spherical: {
    const double height = camera.vertical_angle * kRadiansPerDegree / 2;
    if (!(height < kWidest)) return std::nullopt;
    return ViewExtent{0, tangent, 0, std::tan(height) / std::cos(angle)};
  }
  case Kind::ultra_wide_angle: {
    const double height = right > 0 ? angle * up / right : kWidest;
    if (!(height < kWidest)) return std::nullopt;
    return ViewExtent{0, tangent / std::cos(height), 0, std::tan(height) / std::cos(angle)};
  }
  case Kind::cylinder_1:
    return ViewExtent{0, tangent, 0, up / 2 / std::cos(angle)};
  case Kind::cylinder_2:
    return ViewExtent{0, right / 2 / std::cos(angle), 0, tangent};
  case Kind::cylinder_3:
    return ViewExtent{0, tangent, up / 2, 0};
  case Kind::cylinder_4:
    return ViewExtent{right / 2, 0, 0, tangent};
  case Kind::fisheye:
    return ViewExtent{0, tangent, 0, tangent};
  default:
    return std::nullopt;
  }
}

/// The volume that a picture shows: a pyramid or a prism.
class View {
public:
  View(const Camera& camera, const ViewExtent& reach, double margin)
      : reach_(reach), location_(camera.location), forward_(camera.direction), right_(camera.right),
        up_(camera.up) {
    if (camera.kind != Camera::Kind::perspective && camera.kind != Camera::Kind::orthographic)
      for (Vec3* const axis : {&forward_, &right_, &up_})
        *axis = glm::normalize(*axis);
    right_ *= 1 + margin;
    up_ *= 1 + margin;
    // The normal of planes on which all rays are equally far ahead.
    across_ = glm::cross(right_, up_);
    across_ /= glm::dot(across_, forward_);
  }

  bool is_valid() const {
    return std::isfinite(glm::dot(across_, across_)) && std::isfinite(glm::dot(location_, location_));
  }
  double distance_of(const Vec3& point) const { return glm::dot(point - location_, across_); }
  /// Returns half of the view's shorter side at a distance, in lengths of the camera's direction.
  double half_size(double ahead) const {
    const double across = (reach_.across + reach_.across_growth * ahead) * glm::length(right_);
    const double up = (reach_.up + reach_.up_growth * ahead) * glm::length(up_);
    return std::min(across, up) / glm::length(forward_);
  }
  Vec3 corner(double ahead, bool right, bool up) const {
    return location_ + forward_ * ahead +
           right_ * ((right ? 1 : -1) * (reach_.across + reach_.across_growth * ahead)) +
           up_ * ((up ? 1 : -1) * (reach_.up + reach_.up_growth * ahead));
  }

private:
  ViewExtent reach_;
  Vec3 location_, forward_, right_, up_, across_;
};

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  Range times(double factor) const {
    return factor < 0 ? Range{high * factor, low * factor} : Range{low * factor, high * factor};
  }
  Range square() const {
    const double a = low * low, b = high * high;
    return {low <= 0 && high >= 0 ? 0 : std::min(a, b), std::max(a, b)};
  }
};

/// The surface of an object in its own space, or a box around one or several objects.
struct Obstacle {
  enum class Kind { box, plane, quadric } kind;
  double map[3][4];
  Vec3 square{0, 0, 0}; ///< quadrics only
  double linear = 0, constant = 0;

  /// Returns whether the obstacle is outside of the part of the view between two distances.
  bool is_outside(const View& view, double from, double to) const {
    std::array<Range, 3> own;
    for (const double ahead : {from, to})
      for (int corner = 0; corner < 4; ++corner) {
        const Vec3 p = view.corner(ahead, (corner & 1) != 0, (corner & 2) != 0);
        for (std::size_t row = 0; row < 3; ++row)
          own[row].add(map[row][0] * p.x + map[row][1] * p.y + map[row][2] * p.z + map[row][3]);
      }
    const auto excludes_zero = [](const Range& range) { return range.low > 0 || range.high < 0; };
    switch (kind) {
    case Kind::box:
      return std::any_of(own.begin(), own.end(), [](const Range& r) { return r.low > 1 || r.high < -1; });
    case Kind::plane:
      return excludes_zero(own[2]);
    case Kind::quadric:
      break;
    }
    Range value = own[2].times(linear);
    for (std::size_t row = 0; row < 3; ++row) {
      const Range term = own[row].square().times(square[static_cast<int>(row)]);
      value.low += term.low;
      value.high += term.high;
    }
    value.low += constant;
    value.high += constant;
    return excludes_zero(value);
  }
};

Obstacle box_around(const Aabb& around) {
  Obstacle box{Obstacle::Kind::box, {}};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = around.min[axis], high = around.max[axis];
    const double half = std::max((high - low) / 2, 1e-12);
    box.map[axis][axis] = 1 / half;
    box.map[axis][3] = -(low + high) / 2 / half;
  }
  return box;
}

const ExtraRecord& extra_of(const ObjectRecord& object, const SceneImage& image) {
  static constexpr ExtraRecord kNone{};
  if (object.extra == kNoOffset) return kNone;
  return *reinterpret_cast<const ExtraRecord*>(image.base() + object.extra);
}

/// Returns the surface of a plane, quadric or sphere, which the camera may be inside of; the box of any other
/// object.
Obstacle obstacle_of(const ObjectRecord& object, const SceneImage& image) {
  const std::uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
  Obstacle obstacle{Obstacle::Kind::plane, {}};
  for (int i = 0; i < 12; ++i)
    obstacle.map[i / 4][i % 4] = object.geometry[i];
  if (kind == kPrimitiveKind<PlanePrimitive>) return obstacle;
  obstacle.kind = Obstacle::Kind::quadric;
  if (kind == kPrimitiveKind<QuadricPrimitive>) {
    const auto code = static_cast<int>(extra_of(object, image).value[0]);
    obstacle.square = Vec3(code % 3 - 1, code / 3 % 3 - 1, code / 9 % 3 - 1);
    obstacle.linear = code / 27 % 2;
    obstacle.constant = code / 54 - 1;
    return obstacle;
  }
  if (kind != kPrimitiveKind<SpherePrimitive>)
    return box_around(bounding_box(object, extra_of(object, image)));
  obstacle.square = Vec3(1);
  obstacle.constant = -1;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      obstacle.map[row][column] = (column == 3     ? -double{object.geometry[row]}
                                   : row == column ? 1.0
                                                   : 0.0) /
                                  object.geometry[3];
  return obstacle;
}

bool is_instance(const ObjectRecord& object) {
  return (object.kind_and_flags & object_flag::kind_mask) == kInstanceKind;
}

/// Returns the distance, at least `from`, up to which no obstacle is in the view; `to` if there is no
/// obstacle before `to`.
double first_meeting(const Obstacle& obstacle, const View& view, double from, double to, int depth = 0) {
  constexpr int kDeepest = 48;
  if (obstacle.is_outside(view, from, to)) return to;
  if (to - from <= view.half_size(to) || depth == kDeepest) return from;
  const double middle = (from + to) / 2;
  const double nearer = first_meeting(obstacle, view, from, middle, depth + 1);
  return nearer < middle ? nearer : first_meeting(obstacle, view, middle, to, depth + 1);
}

/// Returns the range of distances of the corners of a box.
Range distances_of(const Aabb& box, const View& view) {
  Range distances;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 place;
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = (corner >> axis & 1) != 0 ? box.max[axis] : box.min[axis];
    distances.add(view.distance_of(place));
  }
  return distances;
}

} // namespace

double start_of_rays(const Camera& camera, double margin, const SceneImage& image, PassedLimits* limits) {
  constexpr double kFar = 256;
  constexpr auto kMostObjects = static_cast<std::uint32_t>(most_of(PictureLimit::far_camera_objects));
  const std::optional<ViewExtent> reach = view_extent_of(camera);
  if (!reach) return 0;
  const View view(camera, *reach, margin);
  if (!view.is_valid()) return 0;
  const ImageHeader& header = image.header();
  // Crossings with a mesh that CSG shows and that has no inside vector depend on where rays start.
  if (header.crossed_mesh_count != 0) return 0;
  const auto is_far = [&](double start) { return start > kFar * view.half_size(start); };
  const double farthest = double{kMaxHitDistance} / glm::length(camera.direction);
  if (!is_far(farthest)) return 0;

  double start = farthest;
  bool are_too_many = false;
  const auto* const objects = reinterpret_cast<const ObjectRecord*>(image.base() + header.object_offset);
  if (header.object_count != 0) {
    Aabb bounds;
    std::copy(header.bounds_min, header.bounds_min + 3, bounds.min);
    std::copy(header.bounds_max, header.bounds_max + 3, bounds.max);
    const Range all = distances_of(bounds, view);
    if (!(all.high > 0)) return 0;
    if (is_far(all.low)) {
      start = std::min(start, all.low);
    } else {
      // The camera is inside of an object, or of the box around all objects.
      are_too_many = header.object_count > kMostObjects || header.instance_count != 0;
      for (std::uint32_t i = 0; i < std::min(header.object_count, kMostObjects) && is_far(start); ++i)
        if (!is_instance(objects[i])) start = first_meeting(obstacle_of(objects[i], image), view, 0, start);
    }
  }
  for (std::uint32_t i = 1; i <= header.unbounded_count; ++i)
    start = first_meeting(obstacle_of(*(objects - i), image), view, 0, start);
  if (start == farthest) return 0;
  start -= view.half_size(start); // keeps rays from starting on a surface
  if (!(start > 0 && is_far(start))) return 0;
  if (!are_too_many) return start;
  if (limits != nullptr) limits->insert(PictureLimit::far_camera_objects);
  return 0;
}

} // namespace celltrace
