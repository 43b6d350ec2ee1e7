#include "scene_image/single_precision.hpp"

#include "geometry/triangles.hpp"
#include "scene_image/object_records.hpp"
#include "scene_image/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>

#include <glm/common.hpp>

namespace celltrace::geometry {

namespace {

/// Range of lengths whose products and quotients neither overflow nor vanish.
constexpr double kShort = 1e-9, kLong = 1e9;

double largest(const Vec3& vector) {
  const Vec3 size = glm::abs(vector);
  return std::max({size.x, size.y, size.z});
}

bool are_near(std::initializer_list<Vec3> points) {
  return std::all_of(points.begin(), points.end(), [](const Vec3& point) { return largest(point) < kLong; });
}
bool is_usual(double length) {
  const double size = std::abs(length);
  return size > kShort && size < kLong;
}

// One overload of is_usual() for each shape: returns whether its lengths are certainly in this range.

bool is_usual(const Sphere& sphere) {
  return are_near({sphere.centre}) && is_usual(sphere.radius);
}
bool is_usual(const Box& box) {
  const Vec3 size = glm::abs(box.corner[1] - box.corner[0]);
  return are_near({box.corner[0], box.corner[1]}) && std::min({size.x, size.y, size.z}) > kShort;
}
bool is_usual(const Cylinder& cylinder) {
  return are_near({cylinder.base, cylinder.cap}) && is_usual(cylinder.radius) &&
         is_usual(largest(cylinder.cap - cylinder.base));
}
template <class Other> bool is_usual(const Other&) {
  return false;
}

bool is_usual(const Transform& transform) {
  return transform.is_identity() ||
         (are_near({transform.rows[0], transform.rows[1], transform.rows[2], transform.rows[3]}) &&
          std::abs(transform.determinant()) > kShort);
}

} // namespace

bool fits_single_precision(const Shape& shape, const Transform& transform) {
  if (is_usual(transform) && std::visit([](const auto& one) { return is_usual(one); }, shape)) return true;
  if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape)) {
    const double size = greatest_magnitude((*mesh)->vertices);
    const Vec3 reach =
        glm::abs(transform.rows[0]) + glm::abs(transform.rows[1]) + glm::abs(transform.rows[2]);
    return size * largest(reach) + largest(transform.rows[3]) < kMostCoordinate;
  }
  Object object;
  object.shape = shape;
  object.transform = transform;
  const PlacedShape placed = place_shape(object);
  if (placed.is_empty) return true;
  if (!std::all_of(std::begin(placed.geometry), std::end(placed.geometry),
                   [](float number) { return std::isfinite(number); }))
    return false;
  if (!has_bounds(object)) return true;
  return has_size(placed.bounds());
}

} // namespace celltrace::geometry
