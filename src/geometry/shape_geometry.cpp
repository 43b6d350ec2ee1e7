#include "geometry/shape_geometry.hpp"

#include "geometry/data_shapes.hpp"
#include "geometry/mesh_geometry.hpp"
#include "geometry/polygons.hpp"
#include "geometry/polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace celltrace::geometry {

namespace {

/// Returns POV-Ray's bounding box of a round shape: transforms a box around the shape, along the shape's own
/// axes, and returns the bounding box of that. Its axes are turned about the shape's axis as POV-Ray turns
/// them.
Extent round_extent(const Vec3& base, const Vec3& cap, double radius, const Transform& transform) {
  const Vec3 d = glm::normalize(cap - base);
  const double square = d.x * d.x + d.y * d.y;
  Vec3 across{1, 0, 0}, along{0, 1, 0};
  if (square > 0) {
    // The axes come from the shortest turn of z to the shape's axis, after a turn about z.
    const Vec3 x = Vec3(1, 0, 0) - (d + Vec3(0, 0, 1)) * (d.x / (1 + d.z));
    const Vec3 y = Vec3(0, 1, 0) - (d + Vec3(0, 0, 1)) * (d.y / (1 + d.z));
    const double cosine = 2 * d.x * d.y / square, sine = (d.y * d.y - d.x * d.x) / square;
    across = x * cosine + y * sine;
    along = x * -sine + y * cosine;
  }
  std::vector<Vec3> corners;
  for (int corner = 0; corner < 8; ++corner)
    corners.push_back(transform.point((corner & 1 ? cap : base) + across * (corner & 2 ? radius : -radius) +
                                      along * (corner & 4 ? radius : -radius)));
  return Extent::around(corners);
}

// Overloads of cross(), contains() and extent() for each shape. A round shape's extent() also transforms the
// shape.

void cross(const Sphere& s, const Ray& ray, Crossings& found) {
  const Vec3 o = ray.origin - s.centre;
  const double a = glm::dot(ray.direction, ray.direction), b = glm::dot(o, ray.direction);
  const double root = b * b - a * (glm::dot(o, o) - s.radius * s.radius);
  if (root <= 0) return;
  for (const double sign : {-1.0, 1.0}) {
    const double t = (-b + sign * std::sqrt(root)) / a;
    found.push_back({t, ray.at(t) - s.centre});
  }
}
bool contains(const Sphere& s, const Vec3& p) {
  return glm::dot(p - s.centre, p - s.centre) < s.radius * s.radius;
}
Extent extent(const Sphere& s) {
  return {s.centre - Vec3(std::fabs(s.radius)), s.centre + Vec3(std::fabs(s.radius))};
}

void cross(const Plane& plane, const Ray& ray, Crossings& found) {
  const Vec3 n = glm::normalize(plane.normal);
  const double slope = glm::dot(n, ray.direction);
  if (slope != 0) found.push_back({(plane.distance - glm::dot(n, ray.origin)) / slope, n});
}
bool contains(const Plane& plane, const Vec3& p) {
  return glm::dot(glm::normalize(plane.normal), p) < plane.distance;
}
Extent extent(const Plane&) {
  return Extent::everywhere();
}

void cross(const Disc& disc, const Ray& ray, Crossings& found) {
  const double length = glm::length(disc.normal);
  if (length == 0) return;
  const Vec3 n = disc.normal / length;
  const double slope = glm::dot(n, ray.direction);
  if (slope == 0) return;
  const double t = glm::dot(n, disc.centre - ray.origin) / slope;
  const double distance = glm::length(ray.at(t) - disc.centre);
  if (distance <= std::fabs(disc.radius) && distance >= std::fabs(disc.hole_radius)) found.push_back({t, n});
}
bool contains(const Disc& disc, const Vec3& p) {
  return glm::dot(disc.normal, p - disc.centre) < 0;
}
Extent extent(const Disc& disc, const Transform& transform) {
  constexpr double kThickness = 0.001;
  if (glm::length(disc.normal) == 0) return Extent::around({transform.point(disc.centre)});
  const Vec3 n = glm::normalize(disc.normal) * kThickness;
  return round_extent(disc.centre - n, disc.centre + n, disc.radius, transform);
}

Box ordered(const Box& box) {
  return {{glm::min(box.corner[0], box.corner[1]), glm::max(box.corner[0], box.corner[1])}};
}
void cross(const Box& box, const Ray& ray, Crossings& found) {
  const Box b = ordered(box);
  double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
  Vec3 enter_normal(0), leave_normal(0);
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    if (d == 0) {
      if (ray.origin[axis] < b.corner[0][axis] || ray.origin[axis] > b.corner[1][axis]) return;
      continue;
    }
    const double near = (b.corner[d > 0 ? 0 : 1][axis] - ray.origin[axis]) / d;
    const double far = (b.corner[d > 0 ? 1 : 0][axis] - ray.origin[axis]) / d;
    Vec3 normal(0);
    normal[axis] = d > 0 ? 1 : -1;
    if (near > enter) enter = near, enter_normal = -normal;
    if (far < leave) leave = far, leave_normal = normal;
  }
  if (enter > leave) return;
  found.push_back({enter, enter_normal});
  found.push_back({leave, leave_normal});
}
bool contains(const Box& box, const Vec3& p) {
  const Box b = ordered(box);
  return glm::all(glm::greaterThanEqual(p, b.corner[0])) && glm::all(glm::lessThanEqual(p, b.corner[1]));
}
Extent extent(const Box& box) {
  const Box b = ordered(box);
  return {b.corner[0], b.corner[1]};
}

Cone with_positive_radii(Cone cone) {
  cone.base_radius = std::fabs(cone.base_radius);
  cone.cap_radius = std::fabs(cone.cap_radius);
  return cone;
}
void cross(const Cone& any_cone, const Ray& ray, Crossings& found) {
  const Cone cone = with_positive_radii(any_cone);
  const Vec3 axis = cone.cap - cone.base;
  const double length = glm::length(axis);
  const Vec3 n = axis / length;
  const double slope = (cone.cap_radius - cone.base_radius) / length;
  const Vec3 o = ray.origin - cone.base;
  const double height = glm::dot(o, n), rise = glm::dot(ray.direction, n);
  const Vec3 side = o - n * height, run = ray.direction - n * rise;
  const double radius = cone.base_radius + slope * height, growth = slope * rise;
  const double a = glm::dot(run, run) - growth * growth, b = glm::dot(side, run) - radius * growth,
               c = glm::dot(side, side) - radius * radius;
  const auto add_side = [&](double t) {
    const double h = height + t * rise;
    if (h < 0 || h > length) return;
    const Vec3 out = side + run * t;
    found.push_back({t, out - n * (slope * glm::length(out))});
  };
  if (a != 0) {
    const double root = b * b - a * c;
    if (root >= 0)
      for (const double sign : {-1.0, 1.0})
        add_side((-b + sign * std::sqrt(root)) / a);
  } else if (b != 0) {
    add_side(-c / (2 * b));
  }
  if (cone.open || rise == 0) return;
  for (const bool is_cap : {false, true}) {
    const double t = ((is_cap ? length : 0) - height) / rise;
    const double r = is_cap ? cone.cap_radius : cone.base_radius;
    if (glm::length(side + run * t) <= r) found.push_back({t, is_cap ? n : -n});
  }
}
bool contains(const Cone& any_cone, const Vec3& p) {
  const Cone cone = with_positive_radii(any_cone);
  const Vec3 axis = cone.cap - cone.base;
  const double length = glm::length(axis), height = glm::dot(p - cone.base, axis) / length;
  if (height < 0 || height > length) return false;
  const double radius = cone.base_radius + (cone.cap_radius - cone.base_radius) * height / length;
  return glm::length(p - cone.base - axis * (height / length)) < radius;
}
Extent extent(const Cone& any_cone, const Transform& transform) {
  const Cone cone = with_positive_radii(any_cone);
  // POV-Ray starts at the wide end.
  return cone.base_radius >= cone.cap_radius ? round_extent(cone.base, cone.cap, cone.base_radius, transform)
                                             : round_extent(cone.cap, cone.base, cone.cap_radius, transform);
}

Cone as_cone(const Cylinder& c) {
  return {c.base, c.cap, c.radius, c.radius, c.open};
}
void cross(const Cylinder& c, const Ray& ray, Crossings& found) {
  cross(as_cone(c), ray, found);
}
bool contains(const Cylinder& c, const Vec3& p) {
  return contains(as_cone(c), p);
}
Extent extent(const Cylinder& c, const Transform& transform) {
  return extent(as_cone(c), transform);
}

double torus_value(const Torus& torus, const Vec3& p) {
  const double ring = std::sqrt(p.x * p.x + p.z * p.z) - torus.major_radius;
  return ring * ring + p.y * p.y - torus.minor_radius * torus.minor_radius;
}
void cross(const Torus& torus, const Ray& ray, Crossings& found) {
  // Distances are measured from the point of the ray nearest to the centre, for precision.
  const double length = glm::length(ray.direction);
  const Vec3 d = ray.direction / length;
  const double middle = -glm::dot(ray.origin, d);
  const Vec3 o = ray.origin + d * middle;
  // Searches a little beyond the torus: roots at the ends of a range may be missed.
  const double reach = 1.001 * (std::fabs(torus.major_radius) + std::fabs(torus.minor_radius));
  if (glm::dot(o, o) > reach * reach) return;
  const double R = torus.major_radius * torus.major_radius, r = torus.minor_radius * torus.minor_radius;
  const double k = glm::dot(o, o) + R - r;
  // Coefficients of (t^2 + k)^2 = 4 R (x^2 + z^2)
  const std::vector<double> c = {k * k - 4 * R * (o.x * o.x + o.z * o.z), -8 * R * (o.x * d.x + o.z * d.z),
                                 2 * k - 4 * R * (d.x * d.x + d.z * d.z), 0, 1};
  for (const double t : roots(c, -reach, reach)) {
    const Vec3 p = o + d * t;
    const double ring = std::sqrt(p.x * p.x + p.z * p.z);
    const Vec3 tube = ring > 0 ? Vec3(p.x, 0, p.z) * (torus.major_radius / ring) : Vec3(0);
    found.push_back({(t + middle) / length, p - tube});
  }
}
bool contains(const Torus& torus, const Vec3& p) {
  return torus_value(torus, p) < 0;
}
Extent extent(const Torus& torus) {
  const double r = std::fabs(torus.minor_radius), reach = std::fabs(torus.major_radius) + r;
  return {{-reach, -r, -reach}, {reach, r, reach}};
}

double quadric_value(const Quadric& q, const Vec3& p) {
  return glm::dot(q.square, p * p) + glm::dot(q.mixed, Vec3(p.x * p.y, p.x * p.z, p.y * p.z)) +
         glm::dot(q.linear, p) + q.constant;
}
Vec3 quadric_slope(const Quadric& q, const Vec3& p) {
  return q.square * p * 2.0 + q.linear +
         Vec3(q.mixed.x * p.y + q.mixed.y * p.z, q.mixed.x * p.x + q.mixed.z * p.z,
              q.mixed.y * p.x + q.mixed.z * p.y);
}
void cross(const Quadric& q, const Ray& ray, Crossings& found) {
  const Vec3& d = ray.direction;
  const double a = glm::dot(q.square, d * d) + glm::dot(q.mixed, Vec3(d.x * d.y, d.x * d.z, d.y * d.z));
  const double b = glm::dot(quadric_slope(q, ray.origin), d), c = quadric_value(q, ray.origin);
  const auto add = [&](double t) { found.push_back({t, quadric_slope(q, ray.at(t))}); };
  if (a == 0) {
    if (b != 0) add(-c / b);
    return;
  }
  const double root = b * b - 4 * a * c;
  if (root < 0) return;
  for (const double sign : {-1.0, 1.0})
    add((-b + sign * std::sqrt(root)) / (2 * a));
}
bool contains(const Quadric& q, const Vec3& p) {
  return quadric_value(q, p) < 0;
}
/// Returns the box of an ellipsoid whose axes are the coordinate axes; infinite for any other quadric.
Extent extent(const Quadric& q) {
  const bool is_ellipsoid = q.mixed == Vec3(0) && q.square.x > 0 && q.square.y > 0 && q.square.z > 0;
  if (!is_ellipsoid) return Extent::everywhere();
  const Vec3 centre = q.linear / (q.square * -2.0);
  const double level = glm::dot(q.square, centre * centre) - q.constant;
  if (level < 0) return {centre, centre};
  const Vec3 half = glm::sqrt(Vec3(level) / q.square);
  return {centre - half, centre + half};
}

/// Returns the size of a point relative to the surface: 1 on the surface, less inside, and in proportion to
/// the distance from the centre.
double superellipsoid_size(const Superellipsoid& s, const Vec3& p) {
  const auto [across, along] = powers_of(s);
  const auto norm = [](double a, double b, double exponent) {
    const double greater = std::max(std::fabs(a), std::fabs(b)), less = std::min(std::fabs(a), std::fabs(b));
    return greater == 0 ? 0 : greater * std::pow(1 + std::pow(less / greater, exponent), 1 / exponent);
  };
  return norm(norm(p.x, p.y, across), p.z, along);
}
Vec3 superellipsoid_slope(const Superellipsoid& s, const Vec3& p) {
  const auto [across, along] = powers_of(s);
  const auto term = [](double x, double exponent) {
    return x == 0 ? 0 : std::copysign(std::pow(std::fabs(x), exponent - 1), x);
  };
  const double sum = std::pow(std::fabs(p.x), across) + std::pow(std::fabs(p.y), across);
  const double factor = sum == 0 ? 0 : std::pow(sum, along / across - 1);
  return {factor * term(p.x, across), factor * term(p.y, across), term(p.z, along)};
}
void cross(const Superellipsoid& s, const Ray& ray, Crossings& found) {
  // Searches a little beyond the bounding box, in parts that lie in one octant each: in a part the size has
  // at most one extremum.
  constexpr double kReach = 1.001;
  double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
  std::vector<double> places;
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.direction[axis] == 0) {
      if (std::fabs(ray.origin[axis]) > kReach) return;
      continue;
    }
    const double middle = -ray.origin[axis] / ray.direction[axis];
    const double half = std::fabs(kReach / ray.direction[axis]);
    enter = std::max(enter, middle - half);
    leave = std::min(leave, middle + half);
    places.push_back(middle);
  }
  if (enter >= leave) return;
  for (double& place : places)
    place = std::clamp(place, enter, leave);
  places.insert(places.end(), {enter, leave});
  std::sort(places.begin(), places.end());
  const auto is_outside = [&](double t) { return superellipsoid_size(s, ray.at(t)) > 1; };
  const auto add_between = [&](double low, double high) {
    const bool falls = is_outside(low);
    if (falls == is_outside(high)) return;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (low + high);
      (is_outside(middle) == falls ? low : high) = middle;
    }
    found.push_back({high, superellipsoid_slope(s, ray.at(high))});
  };
  for (std::size_t i = 1; i < places.size(); ++i) {
    double low = places[i - 1], high = places[i];
    const double sign = is_outside(low) ? 1 : -1;
    if (is_outside(low) == is_outside(high))
      for (int third = 0; third < 80; ++third) {
        const double first = (2 * low + high) / 3, second = (low + 2 * high) / 3;
        const bool is_before =
            sign * superellipsoid_size(s, ray.at(first)) < sign * superellipsoid_size(s, ray.at(second));
        (is_before ? high : low) = is_before ? second : first;
      }
    else
      low = high;
    add_between(places[i - 1], low);
    add_between(low, places[i]);
  }
}
bool contains(const Superellipsoid& s, const Vec3& p) {
  return superellipsoid_size(s, p) < 1;
}
Extent extent(const Superellipsoid&) {
  constexpr double kPadded = 1.0001;
  return {Vec3(-kPadded), Vec3(kPadded)};
}

void cross(const std::shared_ptr<const Mesh>& mesh, const Ray& ray, Crossings& found) {
  find_crossings(*mesh, ray, found);
}
bool contains(const std::shared_ptr<const Mesh>& mesh, const Vec3& p) {
  return is_inside(*mesh, p);
}
Extent extent(const std::shared_ptr<const Mesh>& mesh) {
  return extent_of(*mesh);
}

void cross(const std::shared_ptr<const Polygon>& polygon, const Ray& ray, Crossings& found) {
  const std::optional<Transform> frame = frame_of(*polygon);
  if (!frame) return;
  const Transform to_frame = frame->inverse();
  const Vec3 origin = to_frame.point(ray.origin), direction = to_frame.direction(ray.direction);
  if (direction.z == 0) return;
  const double t = -origin.z / direction.z;
  const Vec3 p = origin + direction * t;
  bool is_in = false;
  for (const std::vector<Vec3>& loop : polygon->loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 a = to_frame.point(loop[i]), b = to_frame.point(loop[i + 1 == loop.size() ? 0 : i + 1]);
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)) is_in = !is_in;
    }
  if (is_in) found.push_back({t, frame->rows[2]});
}
bool contains(const std::shared_ptr<const Polygon>&, const Vec3&) {
  return false;
}
Extent extent(const std::shared_ptr<const Polygon>& polygon) {
  std::vector<Vec3> points;
  for (const std::vector<Vec3>& loop : polygon->loops)
    points.insert(points.end(), loop.begin(), loop.end());
  return Extent::around(points);
}
/// Gives flat boxes a thickness, as POV-Ray does.
Extent thickened(Extent extent) {
  constexpr double kFlat = 1e-6, kThickness = 0.001;
  for (int axis = 0; axis < 3; ++axis) {
    if (extent.max[axis] - extent.min[axis] >= kFlat) continue;
    extent.min[axis] -= kThickness;
    extent.max[axis] += kThickness;
  }
  return extent;
}

// Shapes of many parts are in data_shapes.cpp.
template <class S> void cross(const std::shared_ptr<const S>& shape, const Ray& ray, Crossings& found) {
  find_crossings(*shape, ray, found);
}
template <class S> bool contains(const std::shared_ptr<const S>& shape, const Vec3& p) {
  return is_inside(*shape, p);
}
template <class S> Extent extent(const std::shared_ptr<const S>& shape) {
  return extent_of(*shape);
}

void cross(const std::shared_ptr<const Csg>&, const Ray&, Crossings&) {
}
bool contains(const std::shared_ptr<const Csg>&, const Vec3&) {
  return false;
}
Extent extent(const std::shared_ptr<const Csg>&) {
  return Extent::everywhere();
}

/// Returns the tightest box of a sphere that is only turned and scaled along its axes; nothing for any other
/// transformation.
std::optional<Extent> ellipsoid_extent(const Sphere& sphere, const Transform& transform) {
  const Vec3* rows = transform.rows;
  Vec3 column[3];
  for (int i = 0; i < 3; ++i)
    column[i] = {rows[0][i], rows[1][i], rows[2][i]};
  const auto is_askew = [](const Vec3& a, const Vec3& b) {
    return std::fabs(glm::dot(a, b)) > 1e-9 * glm::length(a) * glm::length(b);
  };
  if (is_askew(column[0], column[1]) || is_askew(column[0], column[2]) || is_askew(column[1], column[2]))
    return std::nullopt;
  const Vec3 centre = transform.point(sphere.centre);
  const Vec3 half =
      Vec3(glm::length(column[0]), glm::length(column[1]), glm::length(column[2])) * std::fabs(sphere.radius);
  return Extent{centre - half, centre + half};
}

template <typename S>
constexpr bool is_round = std::is_same_v<S, Disc> || std::is_same_v<S, Cone> || std::is_same_v<S, Cylinder>;

} // namespace

Powers powers_of(const Superellipsoid& s) {
  constexpr double kLeastExponent = 1e-4;
  return {2 / std::max(s.east_west, kLeastExponent), 2 / std::max(s.north_south, kLeastExponent)};
}

void find_crossings(const Shape& shape, const Ray& ray, Crossings& found) {
  std::visit([&](const auto& s) { cross(s, ray, found); }, shape);
}

bool is_inside(const Shape& shape, const Vec3& point) {
  return std::visit([&](const auto& s) { return contains(s, point); }, shape);
}

Extent extent_of(const Shape& shape, const Transform& transform) {
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    if (const std::optional<Extent> tight = ellipsoid_extent(*sphere, transform)) return *tight;
  const Extent all = std::visit(
      [&](const auto& s) {
        if constexpr (is_round<std::decay_t<decltype(s)>>)
          return extent(s, transform);
        else
          return extent(s).moved(transform);
      },
      shape);
  return std::holds_alternative<std::shared_ptr<const Polygon>>(shape) ? thickened(all) : all;
}

Extent half_space(const Plane& plane, const Transform& transform, bool is_inverse) {
  Extent result = Extent::everywhere();
  Vec3 normal = glm::normalize(transform.normal(plane.normal));
  const Vec3 point = transform.point(glm::normalize(plane.normal) * plane.distance);
  if (is_inverse) normal = -normal;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::fabs(std::fabs(normal[axis]) - 1) > 1e-10) continue;
    (normal[axis] > 0 ? result.max : result.min)[axis] = point[axis];
  }
  return result;
}

} // namespace celltrace::geometry
