#include "scene_image/quadric_bounds.hpp"

#include "scene_image/polytope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace celltrace {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMost = Polytope::kReach; ///< greater coordinates count as infinite

constexpr double kSlack = 1e-4; ///< enlargement of bounds: relative, but absolute below 1, as for half-spaces

struct Range {
  double low, high;

  friend Range operator+(const Range& a, const Range& b) { return {a.low + b.low, a.high + b.high}; }
  friend Range operator-(const Range& a) { return {-a.high, -a.low}; }
};

Range common(const Range& a, const Range& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}
/// Returns a product in which 0 times infinity is 0: a term whose factor is 0 has no influence.
double product(double a, double b) {
  return a == 0 || b == 0 ? 0 : a * b;
}
Range operator*(double factor, const Range& x) {
  const double a = product(factor, x.low), b = product(factor, x.high);
  return {std::min(a, b), std::max(a, b)};
}
Range operator*(const Range& x, const Range& y) {
  const double some[4] = {product(x.low, y.low), product(x.low, y.high), product(x.high, y.low),
                          product(x.high, y.high)};
  return {*std::min_element(some, some + 4), *std::max_element(some, some + 4)};
}

/// Returns the range of square * x^2 + linear * x.
Range parabola(double square, double linear, const Range& x) {
  if (square == 0) return linear * x;
  const auto at = [&](double t) { return std::isinf(t) ? square * t * t : (square * t + linear) * t; };
  Range values = {std::min(at(x.low), at(x.high)), std::max(at(x.low), at(x.high))};
  const double middle = -linear / (2 * square);
  if (x.low < middle && middle < x.high) {
    const double there = linear * middle / 2;
    values = {std::min(values.low, there), std::max(values.high, there)};
  }
  return values;
}

/// Returns the range of x in which square * x^2 + linear * x + rest <= 0 for some values of `linear` and of
/// `rest`; everything if that range is not known.
Range not_above(double square, const Range& linear, const Range& rest) {
  const Range everywhere = {-kInfinity, kInfinity};
  const double least = rest.low;
  if (!(std::abs(least) < kInfinity) || !(std::abs(linear.low) < kInfinity) ||
      !(std::abs(linear.high) < kInfinity))
    return everywhere;
  if (square < 0) return everywhere;
  if (square == 0) {
    Range x = everywhere;
    if (linear.low > 0) x.high = -least / (least < 0 ? linear.low : linear.high);
    if (linear.high < 0) x.low = least / -(least > 0 ? linear.low : linear.high);
    return x;
  }
  // The least value at x comes from one end of `linear` if x > 0, from the other end if x < 0.
  const auto roots = [&](double slope) {
    const double root = slope * slope - 4 * square * least;
    if (root < 0) return Range{kInfinity, -kInfinity};
    return Range{(-slope - std::sqrt(root)) / (2 * square), (-slope + std::sqrt(root)) / (2 * square)};
  };
  const Range above = common(roots(linear.low), {0, kInfinity});
  const Range below = common(roots(linear.high), {-kInfinity, 0});
  const bool is_above = above.low <= above.high, is_below = below.low <= below.high;
  if (!is_above && !is_below) return everywhere; // there is no such x: limits nothing
  return {is_below ? below.low : above.low, is_above ? above.high : below.high};
}

/// The symmetric matrix of a quadric in the world: p * matrix * p with p = (x, y, z, 1).
struct WorldQuadric {
  double matrix[4][4];

  WorldQuadric(const Quadric& q, const Transform& transform) {
    const Transform inverse = transform.inverse();
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const Vec3 &a = inverse.rows[i], &b = inverse.rows[j];
        const double a_far = i == 3, b_far = j == 3;
        matrix[i][j] = q.square.x * a.x * b.x + q.square.y * a.y * b.y + q.square.z * a.z * b.z +
                       (q.mixed.x * (a.x * b.y + a.y * b.x) + q.mixed.y * (a.x * b.z + a.z * b.x) +
                        q.mixed.z * (a.y * b.z + a.z * b.y) +
                        (q.linear.x * a.x + q.linear.y * a.y + q.linear.z * a.z) * b_far +
                        (q.linear.x * b.x + q.linear.y * b.y + q.linear.z * b.z) * a_far) /
                           2 +
                       q.constant * a_far * b_far;
      }
    // Clears entries that are not 0 only because rotations there and back were rounded.
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double one = std::abs(matrix[i][i]), other = std::abs(matrix[j][j]);
        if (i != j &&
            std::abs(matrix[i][j]) <= std::max(1e-6 * std::sqrt(one * other), 1e-12 * std::max(one, other)))
          matrix[i][j] = 0;
      }
  }

  /// Returns the range along one axis of the quadric's points in a box.
  Range along(int axis, bool solid, const Range (&box)[3]) const {
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    const Range linear = 2 * matrix[axis][j] * box[j] + 2 * matrix[axis][k] * box[k] +
                         Range{2 * matrix[axis][3], 2 * matrix[axis][3]};
    const Range rest = parabola(matrix[j][j], 2 * matrix[j][3], box[j]) +
                       parabola(matrix[k][k], 2 * matrix[k][3], box[k]) +
                       2 * matrix[j][k] * (box[j] * box[k]) + Range{matrix[3][3], matrix[3][3]};
    const Range inside = not_above(matrix[axis][axis], linear, rest);
    if (solid) return inside;
    return common(inside, not_above(-matrix[axis][axis], -linear, -rest));
  }
};

} // namespace

kernel::Aabb bounds_of_quadric(const Quadric& quadric, const Transform& transform, bool solid,
                               const kernel::Aabb& within) {
  for (int i = 0; i < 3; ++i)
    if (within.min[i] > within.max[i]) return within;
  const WorldQuadric q(quadric, transform);
  Range box[3];
  for (int i = 0; i < 3; ++i)
    box[i] = {within.min[i] > -kMost ? within.min[i] : -kInfinity,
              within.max[i] < kMost ? within.max[i] : kInfinity};
  kernel::Aabb result = within;
  // The range along one axis may limit those along the others, so that a second round finds tighter ranges.
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 3; ++i) {
      const Range found = q.along(i, solid, box);
      if (std::abs(found.low) < kMost)
        box[i].low = std::max(box[i].low, found.low - kSlack * (1 + std::abs(found.low)));
      if (std::abs(found.high) < kMost)
        box[i].high = std::min(box[i].high, found.high + kSlack * (1 + std::abs(found.high)));
    }
  for (int i = 0; i < 3; ++i) {
    if (box[i].low > -kMost) result.min[i] = static_cast<float>(box[i].low);
    if (box[i].high < kMost) result.max[i] = static_cast<float>(box[i].high);
  }
  return result;
}

} // namespace celltrace
