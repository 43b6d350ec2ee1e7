#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/geometric.hpp>

#include "celltrace/error.hpp"
#include "celltrace/scene.hpp"

namespace celltrace {

namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180;

/// The transposed adjugate of a linear map: its rows are cross products of the map's rows.
struct Cofactors {
  Vec3 rows[3];
};

Cofactors cofactors(const Vec3 (&rows)[4]) {
  return {{glm::cross(rows[1], rows[2]), glm::cross(rows[2], rows[0]), glm::cross(rows[0], rows[1])}};
}

/// Computes sine and cosine. Quarter turns give exact results, since scenes place walls and mirrors by them.
void sine_and_cosine(double degrees, double& sine, double& cosine) {
  const double quarters = degrees / 90;
  if (!std::isfinite(quarters) || quarters != std::floor(quarters)) {
    sine = std::sin(degrees * kRadiansPerDegree);
    cosine = std::cos(degrees * kRadiansPerDegree);
    return;
  }
  static constexpr double kSines[] = {0, 1, 0, -1};
  const int quarter = static_cast<int>(std::fmod(std::fmod(quarters, 4) + 4, 4));
  sine = kSines[quarter];
  cosine = kSines[(quarter + 1) % 4];
}

} // namespace

Transform Transform::translate(const Vec3& offset) {
  Transform result;
  result.rows[3] = offset;
  return result;
}

Transform Transform::rotate(const Vec3& degrees) {
  double s = 0;
  double c = 1;
  Transform about_x;
  sine_and_cosine(degrees.x, s, c);
  about_x.rows[1] = {0, c, s};
  about_x.rows[2] = {0, -s, c};
  Transform about_y;
  sine_and_cosine(degrees.y, s, c);
  about_y.rows[0] = {c, 0, -s};
  about_y.rows[2] = {s, 0, c};
  Transform about_z;
  sine_and_cosine(degrees.z, s, c);
  about_z.rows[0] = {c, s, 0};
  about_z.rows[1] = {-s, c, 0};
  return about_x.then(about_y).then(about_z);
}

Transform Transform::scale(const Vec3& factors) {
  const auto factor = [](double f) { return f == 0 ? 1.0 : f; };
  Transform result;
  result.rows[0].x = factor(factors.x);
  result.rows[1].y = factor(factors.y);
  result.rows[2].z = factor(factors.z);
  return result;
}

Transform Transform::matrix(const double (&values)[12]) {
  Transform result;
  for (int row = 0; row < 4; ++row)
    result.rows[row] = {values[3 * row], values[3 * row + 1], values[3 * row + 2]};
  return result;
}

Vec3 Transform::normal(const Vec3& n) const {
  const Cofactors c = cofactors(rows);
  const Vec3 scaled = n.x * c.rows[0] + n.y * c.rows[1] + n.z * c.rows[2];
  return scaled / determinant();
}

double Transform::determinant() const {
  return glm::dot(rows[0], glm::cross(rows[1], rows[2]));
}

Transform Transform::inverse() const {
  const double det = determinant();
  if (det == 0 || !std::isfinite(1 / det)) throw InputError("a transformation is singular");
  const Cofactors c = cofactors(rows);
  Transform result;
  for (int row = 0; row < 3; ++row)
    result.rows[row] = Vec3(c.rows[0][row], c.rows[1][row], c.rows[2][row]) / det;
  result.rows[3] = -result.direction(rows[3]);
  return result;
}

Transform Transform::then(const Transform& next) const {
  // Most objects are not moved, which makes the product trivial.
  if (next.is_identity()) return *this;
  if (is_identity()) return next;
  Transform result;
  for (int row = 0; row < 3; ++row)
    result.rows[row] = next.direction(rows[row]);
  result.rows[3] = next.point(rows[3]);
  return result;
}

bool Transform::is_identity() const {
  const Transform identity;
  return std::equal(std::begin(rows), std::end(rows), std::begin(identity.rows));
}

} // namespace celltrace
