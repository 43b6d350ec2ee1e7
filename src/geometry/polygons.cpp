#include "geometry/polygons.hpp"

#include "geometry/basis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace celltrace {

namespace {

template <class Visit> void for_each_point(const Polygon& polygon, Visit visit) {
  for (const std::vector<Vec3>& loop : polygon.loops)
    for (const Vec3& point : loop)
      visit(point);
}

/// Returns the normal of the first corner that is not flat, compared with the polygon's size; zero if all
/// corners are flat.
Vec3 normal_of(const Polygon& polygon) {
  constexpr double kFlat = 1e-12;
  std::optional<Vec3> start;
  double reach = 0;
  for_each_point(polygon, [&](const Vec3& point) {
    if (!start) start = point;
    reach = std::max(reach, glm::distance(*start, point));
  });
  if (reach == 0) return Vec3(0);
  std::optional<Vec3> side;
  Vec3 normal(0);
  for_each_point(polygon, [&](const Vec3& point) {
    if (normal != Vec3(0)) return;
    const Vec3 to = (point - *start) / reach;
    if (!side) {
      if (glm::dot(to, to) > kFlat) side = to;
      return;
    }
    const Vec3 across = glm::cross(*side, to);
    if (glm::dot(across, across) > kFlat * glm::dot(*side, *side)) normal = glm::normalize(across);
  });
  return normal;
}

} // namespace

std::optional<Transform> frame_of(const Polygon& polygon) {
  const Vec3 normal = normal_of(polygon);
  if (normal == Vec3(0)) return std::nullopt;
  Transform frame;
  Vec3 x, y;
  complete_basis(normal, x, y);
  const double height = glm::dot(polygon.loops.front().front(), normal);
  glm::dvec2 least(std::numeric_limits<double>::infinity()), greatest = -least;
  for_each_point(polygon, [&](const Vec3& point) {
    const glm::dvec2 at(glm::dot(point, x), glm::dot(point, y));
    least = glm::min(least, at);
    greatest = glm::max(greatest, at);
  });
  const glm::dvec2 half = 0.5 * (greatest - least), middle = 0.5 * (greatest + least);
  if (!(half.x > 0 && half.y > 0)) return std::nullopt;
  frame.rows[0] = x * half.x;
  frame.rows[1] = y * half.y;
  frame.rows[2] = normal * std::max(half.x, half.y);
  frame.rows[3] = x * middle.x + y * middle.y + normal * height;
  return frame;
}

Mesh triangles_of(const Polygon& polygon, const Transform& to_world) {
  // Limits the corners: triangles around one of many corners are thin, so that rays that are tested against
  // them miss more often than rays that are tested against the polygon.
  constexpr std::size_t kMostCorners = 8;
  constexpr double kFlat = 1e-6; // as a share of the extent
  if (polygon.loops.size() != 1 || polygon.loops[0].size() < 3 || polygon.loops[0].size() > kMostCorners)
    return {};
  const std::optional<Transform> frame = frame_of(polygon);
  if (!frame) return {};
  const Transform to_frame = frame->inverse();
  std::vector<Vec3> corners;
  for (const Vec3& point : polygon.loops[0]) {
    corners.push_back(to_frame.point(point));
    if (!(std::fabs(corners.back().z) < kFlat)) return {};
  }
  const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
    const Vec3 ab = corners[b] - corners[a], ac = corners[c] - corners[a];
    return ab.x * ac.y - ab.y * ac.x;
  };
  // Rejects stars: in a star with five points all corners turn to one side, but not all triangles do.
  const std::size_t count = corners.size();
  const double side = turn(0, 1, 2);
  for (std::size_t i = 0; i < count; ++i)
    if (!(turn(i, (i + 1) % count, (i + 2) % count) * side > 0)) return {};
  for (std::size_t i = 1; i + 1 < count; ++i)
    if (!(turn(0, i, i + 1) * side > 0)) return {};

  Mesh mesh;
  for (const Vec3& point : polygon.loops[0])
    mesh.vertices.push_back(Vec3f(to_world.point(point)));
  for (Index i = 1; i + 1 < count; ++i)
    mesh.triangles.push_back({{0, i, i + 1}});
  return mesh;
}

} // namespace celltrace
