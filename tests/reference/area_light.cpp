#include "reference/area_light.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace celltrace::reference {

namespace {

struct Quad {
  int left, top, right, bottom;
};

Vec3 mean(const Quad& q, int divisions, const std::function<Vec3(int, int)>& from_place) {
  const Vec3 corner[4] = {from_place(q.left, q.top), from_place(q.right, q.top),
                          from_place(q.right, q.bottom), from_place(q.left, q.bottom)};
  bool divides = divisions > 0;
  for (int i = 0; i < 4; ++i) {
    const Vec3 between = glm::abs(corner[i] - corner[(i + 1) % 4]);
    divides |= between.x + between.y + between.z > 0.1;
  }
  if (!divides || (q.right - q.left <= 1 && q.bottom - q.top <= 1))
    return (corner[0] + corner[1] + corner[2] + corner[3]) * 0.25;
  const int x[4] = {q.left, (q.left + q.right) / 2, (q.left + q.right + 1) / 2, q.right};
  const int y[4] = {q.top, (q.top + q.bottom) / 2, (q.top + q.bottom + 1) / 2, q.bottom};
  Vec3 sum(0);
  for (int column = 0; column < 4; column += 2)
    for (int row = 0; row < 4; row += 2)
      sum += mean({x[column], y[row], x[column + 1], y[row + 1]}, divisions - 1, from_place);
  return sum * 0.25;
}

double part(int place, int places) {
  return places > 1 ? double(place) / (places - 1) - 0.5 : 0;
}

} // namespace

Vec3 area_offset(const LightArea& area, const Vec3& toward, int column, int row) {
  double u = part(column, area.columns), v = part(row, area.rows);
  if (area.circular || area.orient) {
    u += 0.001;
    v += 0.001;
    const double inward = std::max(std::abs(u), std::abs(v)) / std::hypot(u, v);
    u *= inward;
    v *= inward;
  }
  if (!area.orient) return area.across * u + area.along * v;
  const Vec3 beside = std::abs(toward.z) > 0.99 ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  const Vec3 first = glm::normalize(glm::cross(toward, beside));
  return (first * u + glm::cross(toward, first) * v) * glm::length(area.across);
}

Vec3 area_mean(const LightArea& area, const std::function<Vec3(int, int)>& from_place) {
  return mean({0, 0, area.columns - 1, area.rows - 1}, area.adaptive, from_place);
}

} // namespace celltrace::reference
