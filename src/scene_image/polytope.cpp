#include "scene_image/polytope.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace celltrace {

using kernel::Aabb;

namespace {

/// Returns the distance by which points on a plane may be off, since the plane has single precision.
double slack_at(double coordinate) {
  return 1e-4 * (1.0 + std::abs(coordinate));
}

class BoundsOfPoints {
public:
  void add(const Vec3& point) {
    min_ = glm::min(min_, point);
    max_ = glm::max(max_, point);
  }
  Aabb with_slack() const {
    constexpr float kInfinite = std::numeric_limits<float>::max();
    Aabb box;
    for (int i = 0; i < 3; ++i) {
      if (min_[i] > max_[i]) {
        box.min[i] = kInfinite;
        box.max[i] = -kInfinite;
        continue;
      }
      const double low = min_[i] - slack_at(min_[i]), high = max_[i] + slack_at(max_[i]);
      box.min[i] = low < -Polytope::kReach ? -kInfinite : static_cast<float>(low);
      box.max[i] = high > Polytope::kReach ? kInfinite : static_cast<float>(high);
    }
    return box;
  }

private:
  Vec3 min_ = Vec3(std::numeric_limits<double>::max());
  Vec3 max_ = Vec3(std::numeric_limits<double>::lowest());
};

/// Puts the corners of a convex polygon in order, and removes duplicates.
void order_around(std::vector<Vec3>& corners, const Vec3& normal) {
  Vec3 centre(0);
  for (const Vec3& corner : corners)
    centre += corner / static_cast<double>(corners.size());
  Vec3 across(0);
  for (const Vec3& corner : corners)
    if (glm::dot(corner - centre, corner - centre) > glm::dot(across, across)) across = corner - centre;
  const Vec3 up = glm::cross(normal, across);
  std::vector<std::pair<double, Vec3>> by_angle;
  for (const Vec3& p : corners)
    by_angle.push_back({std::atan2(glm::dot(p - centre, up), glm::dot(p - centre, across)), p});
  std::sort(by_angle.begin(), by_angle.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::transform(by_angle.begin(), by_angle.end(), corners.begin(), [](const auto& a) { return a.second; });
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
}

} // namespace

Polytope::Polytope(const Aabb& box) {
  double at[2][3];
  for (int i = 0; i < 3; ++i) {
    at[0][i] = std::max(static_cast<double>(box.min[i]), -2 * kReach);
    at[1][i] = std::min(static_cast<double>(box.max[i]), 2 * kReach);
    if (at[0][i] > at[1][i]) return;
  }
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      Face face{{}, kBox};
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (const auto& [i, j] : {std::pair(0, 0), std::pair(0, 1), std::pair(1, 1), std::pair(1, 0)}) {
        Vec3 corner;
        corner[axis] = at[side][axis];
        corner[u] = at[i][u];
        corner[v] = at[j][v];
        face.corners.push_back(corner);
      }
      faces_.push_back(std::move(face));
    }
}

void Polytope::cut(const Vec3& normal, double offset, std::size_t source) {
  const double length = glm::length(normal);
  // The tolerance is far less than the slack, and far more than rounding errors, so that a plane that is
  // given twice cuts once.
  const double slack = slack_at(offset / length), tolerance = 1e-3 * slack;
  cut_exactly(normal / length, offset / length + slack, tolerance, source);
}

void Polytope::cut_exactly(const Vec3& unit, double offset, double tolerance, std::size_t source) {
  const auto height = [&](const Vec3& p) { return glm::dot(unit, p) - offset; };
  const auto is_beyond = [&](const Vec3& p) { return height(p) > tolerance; };
  std::vector<Vec3> on_plane;
  std::vector<Face> left;
  for (Face& face : faces_) {
    if (std::none_of(face.corners.begin(), face.corners.end(), is_beyond)) {
      left.push_back(std::move(face));
      continue;
    }
    Face kept{{}, face.source};
    Vec3 from = face.corners.back();
    double from_height = height(from);
    for (const Vec3& to : face.corners) {
      const double to_height = height(to);
      if ((from_height > tolerance) != (to_height > tolerance)) {
        const double way = std::clamp(from_height / (from_height - to_height), 0.0, 1.0);
        const Vec3 between = from + (to - from) * way;
        kept.corners.push_back(between);
        on_plane.push_back(between);
      }
      if (to_height <= tolerance) kept.corners.push_back(to);
      from = to;
      from_height = to_height;
    }
    if (kept.corners.size() >= 3) left.push_back(std::move(kept));
  }
  faces_ = std::move(left);
  if (faces_.empty() || on_plane.size() < 3) return;
  order_around(on_plane, unit);
  if (on_plane.size() >= 3) faces_.push_back({std::move(on_plane), source});
}

Aabb Polytope::bounds() const {
  BoundsOfPoints all;
  for (const Face& face : faces_)
    for (const Vec3& corner : face.corners)
      all.add(corner);
  return all.with_slack();
}

Aabb Polytope::bounds_of_face(std::size_t source) const {
  for (const Face& face : faces_) {
    if (face.source != source) continue;
    BoundsOfPoints own;
    for (const Vec3& corner : face.corners)
      own.add(corner);
    return own.with_slack();
  }
  return bounds();
}

} // namespace celltrace
