#include "reference/solids.hpp"

#include "geometry/data_shapes.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace celltrace::reference {

namespace {

template <class... F> struct Overloaded : F... { using F::operator()...; };
template <class... F> Overloaded(F...) -> Overloaded<F...>;

using Polynomial = std::vector<double>;

double value(const Polynomial& p, double x) {
  double sum = 0;
  for (std::size_t i = p.size(); i-- > 0;)
    sum = sum * x + p[i];
  return sum;
}

/// Between two places where the signs differ.
double zero_between(const Polynomial& p, double low, double high) {
  const bool rises = value(p, low) < 0;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    ((value(p, middle) < 0) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// In the shape's own direction along an axis from base to cap: how far, as a share, and the rest.
struct AlongAxis {
  double share;
  Vec3 aside;
};
AlongAxis along(const Vec3& v, const Vec3& axis) {
  const double share = glm::dot(v, axis) / glm::dot(axis, axis);
  return {share, v - share * axis};
}

/// A cylinder is a cone of equal radii.
struct Frustum {
  Vec3 base, axis;
  double base_radius, cap_radius;
  bool open;

  double radius(double share) const { return base_radius + share * (cap_radius - base_radius); }
  /// Below 0 inside, between the ends.
  double side(const Vec3& p) const {
    const AlongAxis at = along(p - base, axis);
    return glm::dot(at.aside, at.aside) - radius(at.share) * radius(at.share);
  }
  bool contains(const Vec3& p) const {
    const double share = along(p - base, axis).share;
    return share > 0 && share < 1 && side(p) < 0;
  }
  std::vector<double> crossings(const Vec3& origin, const Vec3& direction) const {
    const AlongAxis o = along(origin - base, axis), d = along(direction, axis);
    const double r = radius(o.share), grows = d.share * (cap_radius - base_radius);
    std::vector<double> found;
    for (const double t :
         real_zeros({glm::dot(o.aside, o.aside) - r * r, 2 * (glm::dot(o.aside, d.aside) - r * grows),
                     glm::dot(d.aside, d.aside) - grows * grows}))
      if (const double share = o.share + t * d.share; share >= 0 && share <= 1) found.push_back(t);
    if (open || d.share == 0) return found;
    for (const double end : {0.0, 1.0}) {
      const double t = (end - o.share) / d.share;
      if (glm::length(o.aside + t * d.aside) < radius(end)) found.push_back(t);
    }
    return found;
  }
  Vec3 normal(const Vec3& p) const {
    const AlongAxis at = along(p - base, axis);
    const double off_side = std::abs(glm::length(at.aside) - radius(at.share));
    const double length = glm::length(axis);
    if (!open && std::min(std::abs(at.share), std::abs(1 - at.share)) * length < off_side)
      return at.share < 0.5 ? -axis : axis;
    return at.aside - axis * (radius(at.share) * (cap_radius - base_radius) / (length * length));
  }
};
Frustum frustum(const Cylinder& c) {
  return {c.base, c.cap - c.base, c.radius, c.radius, c.open};
}
Frustum frustum(const Cone& c) {
  return {c.base, c.cap - c.base, c.base_radius, c.cap_radius, c.open};
}

Vec3 low(const Box& box) {
  return glm::min(box.corner[0], box.corner[1]);
}
Vec3 high(const Box& box) {
  return glm::max(box.corner[0], box.corner[1]);
}

std::vector<double> cross(const Plane& plane, const Vec3& origin, const Vec3& direction) {
  const Vec3 normal = glm::normalize(plane.normal);
  const double speed = glm::dot(normal, direction);
  if (speed == 0) return {};
  return {(plane.distance - glm::dot(normal, origin)) / speed};
}

std::vector<double> cross(const Disc& disc, const Vec3& origin, const Vec3& direction) {
  const Vec3 normal = glm::normalize(disc.normal);
  std::vector<double> found = cross(Plane{normal, glm::dot(normal, disc.centre)}, origin, direction);
  if (found.empty()) return {};
  const double away = glm::length(origin + found[0] * direction - disc.centre);
  if (away > disc.radius || away < disc.hole_radius) return {};
  return found;
}

/// Where a line from a point of the plane to one side of it crosses the loops an odd number of times.
std::vector<double> cross(const std::shared_ptr<const Polygon>& polygon, const Vec3& origin,
                          const Vec3& direction) {
  const auto& first = polygon->loops.at(0);
  const Vec3 normal = glm::normalize(glm::cross(first.at(1) - first.at(0), first.at(2) - first.at(0)));
  const std::vector<double> found = cross(Plane{normal, glm::dot(normal, first[0])}, origin, direction);
  if (found.empty()) return {};
  const Vec3 side = glm::normalize(first[1] - first[0]), up = glm::cross(normal, side);
  const Vec3 p = origin + found[0] * direction;
  bool is_in = false;
  for (const auto& loop : polygon->loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 a = loop[i] - p, b = loop[(i + 1) % loop.size()] - p;
      const double ay = glm::dot(a, up), by = glm::dot(b, up);
      if ((ay > 0) == (by > 0)) continue;
      is_in ^= glm::dot(a, side) + (glm::dot(b, side) - glm::dot(a, side)) * ay / (ay - by) > 0;
    }
  return is_in ? found : std::vector<double>();
}

/// Shapes of many parts are those of src/geometry, which tests compare with POV-Ray's numbers.
template <class Shape>
std::vector<double> cross(const std::shared_ptr<const Shape>& shape, const Vec3& origin, const Vec3& direction) {
  geometry::Crossings found;
  geometry::find_crossings(*shape, {origin, direction}, found);
  std::vector<double> distances;
  for (const geometry::Crossing& crossing : found)
    distances.push_back(crossing.t);
  std::sort(distances.begin(), distances.end());
  return distances;
}
/// Returns the normal where rays along the axes cross the surface nearest to the point.
template <class Shape> Vec3 normal_near(const Shape& shape, const Vec3& p) {
  geometry::Crossing nearest{HUGE_VAL, Vec3(0)};
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 direction(0.01);
    direction[axis] = 1;
    geometry::Crossings found;
    geometry::find_crossings(shape, {p, direction}, found);
    for (const geometry::Crossing& crossing : found)
      if (std::abs(crossing.t) < std::abs(nearest.t)) nearest = crossing;
  }
  return nearest.normal;
}

std::vector<double> cross(const Box& box, const Vec3& origin, const Vec3& direction) {
  double enter = -HUGE_VAL, leave = HUGE_VAL;
  for (int i = 0; i < 3; ++i) {
    double first = (low(box)[i] - origin[i]) / direction[i], last = (high(box)[i] - origin[i]) / direction[i];
    if (direction[i] == 0) {
      const bool is_within = origin[i] >= low(box)[i] && origin[i] <= high(box)[i];
      first = is_within ? -HUGE_VAL : HUGE_VAL;
      last = -first;
    }
    enter = std::max(enter, std::min(first, last));
    leave = std::min(leave, std::max(first, last));
  }
  if (enter > leave) return {};
  return {enter, leave};
}

std::vector<double> cross(const Torus& torus, const Vec3& from, const Vec3& towards) {
  // From the point closest to the middle, in units in which the direction is of unit length.
  const double length = glm::length(towards);
  const Vec3 d = towards / length;
  const double middle = -glm::dot(from, d);
  const Vec3 o = from + d * middle;
  const double major = torus.major_radius * torus.major_radius;
  // (|p|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + z^2), and |p|^2 = |o|^2 + t^2.
  const double k = glm::dot(o, o) + major - torus.minor_radius * torus.minor_radius;
  std::vector<double> found =
      real_zeros({k * k - 4 * major * (o.x * o.x + o.z * o.z), -8 * major * (o.x * d.x + o.z * d.z),
                  2 * k - 4 * major * (d.x * d.x + d.z * d.z), 0, 1});
  for (double& t : found)
    t = (t + middle) / length;
  return found;
}

/// The function that a quadric is the zeros of.
double function(const Quadric& q, const Vec3& p) {
  return glm::dot(q.square, p * p) + glm::dot(q.mixed, Vec3(p.x * p.y, p.x * p.z, p.y * p.z)) +
         glm::dot(q.linear, p) + q.constant;
}
Vec3 gradient(const Quadric& q, const Vec3& p) {
  return 2.0 * q.square * p + q.linear +
         Vec3(q.mixed.x * p.y + q.mixed.y * p.z, q.mixed.x * p.x + q.mixed.z * p.z,
              q.mixed.y * p.x + q.mixed.z * p.y);
}

std::vector<double> cross(const Quadric& q, const Vec3& origin, const Vec3& direction) {
  const double at_origin = function(q, origin), slope = glm::dot(gradient(q, origin), direction);
  return real_zeros({at_origin, slope, function(q, origin + direction) - at_origin - slope});
}

/// Less the 1 that it is on the surface.
double function(const Superellipsoid& s, const Vec3& p) {
  const double east_west = 2 / s.east_west, north_south = 2 / s.north_south;
  return std::pow(std::pow(std::abs(p.x), east_west) + std::pow(std::abs(p.y), east_west),
                  north_south / east_west) +
         std::pow(std::abs(p.z), north_south) - 1;
}
Vec3 gradient(const Superellipsoid& s, const Vec3& p) {
  constexpr double kStep = 1e-7;
  Vec3 slope;
  for (int i = 0; i < 3; ++i) {
    Vec3 step(0);
    step[i] = kStep;
    slope[i] = function(s, p + step) - function(s, p - step);
  }
  return slope;
}

/// By steps that are small against all but what grazes it.
std::vector<double> cross(const Superellipsoid& s, const Vec3& origin, const Vec3& direction) {
  constexpr int kSteps = 2000;
  const std::vector<double> box = cross(Box{{Vec3(-1.001), Vec3(1.001)}}, origin, direction);
  if (box.empty()) return {};
  const auto is_in = [&](double t) { return function(s, origin + t * direction) < 0; };
  const auto place = [&](int step) { return box[0] + (box[1] - box[0]) * step / kSteps; };
  std::vector<double> found;
  for (int step = 1; step <= kSteps; ++step) {
    double low = place(step - 1), high = place(step);
    const bool before = is_in(low);
    if (is_in(high) == before) continue;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (is_in(middle) == before ? low : high) = middle;
    }
    found.push_back(high);
  }
  return found;
}

std::vector<double> cross(const Sphere& sphere, const Vec3& origin, const Vec3& direction) {
  const Vec3 o = origin - sphere.centre;
  return real_zeros({glm::dot(o, o) - sphere.radius * sphere.radius, 2 * glm::dot(o, direction),
                     glm::dot(direction, direction)});
}

/// An odd number of triangles lies between a point and infinity.
bool is_in_mesh(const Mesh& mesh, const Vec3& point) {
  if (!mesh.has_inside()) return false;
  bool inside = false;
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    const auto vertex = [&](int i) { return Vec3(mesh.vertices[triangle.vertex[i]]); };
    const Vec3 e1 = vertex(1) - vertex(0), e2 = vertex(2) - vertex(0), offset = point - vertex(0);
    const Vec3 plane = glm::cross(e1, e2), moment = glm::cross(offset, mesh.inside_vector);
    const double volume = -glm::dot(mesh.inside_vector, plane);
    if (volume == 0) continue;
    const double u = glm::dot(e2, moment) / volume, v = -glm::dot(e1, moment) / volume;
    inside ^= u >= 0 && v >= 0 && u + v <= 1 && glm::dot(offset, plane) / volume > 0;
  }
  return inside;
}

bool is_in_csg(const Csg& csg, const Vec3& point) {
  const auto contains = [&](const Object& part) { return is_inside(part, point); };
  const auto begin = csg.parts.begin(), end = csg.parts.end();
  switch (csg.operation) {
  case Csg::Operation::intersection:
    return std::all_of(begin, end, contains);
  case Csg::Operation::difference:
    return begin != end && contains(*begin) && std::none_of(begin + 1, end, contains);
  default:
    return std::any_of(begin, end, contains);
  }
}

bool is_in_shape(const Object& object, const Vec3& p) {
  return std::visit(Overloaded{
                        [&](const Sphere& s) { return glm::length(p - s.centre) < std::abs(s.radius); },
                        [&](const std::shared_ptr<const Mesh>& mesh) { return is_in_mesh(*mesh, p); },
                        [&](const Plane& s) { return glm::dot(glm::normalize(s.normal), p) < s.distance; },
                        [&](const Disc& s) { return glm::dot(s.normal, p - s.centre) < 0; },
                        [&](const Box& s) {
                          for (int i = 0; i < 3; ++i)
                            if (p[i] <= low(s)[i] || p[i] >= high(s)[i]) return false;
                          return true;
                        },
                        [&](const Cylinder& s) { return frustum(s).contains(p); },
                        [&](const Cone& s) { return frustum(s).contains(p); },
                        [&](const Torus& s) {
                          return std::hypot(std::hypot(p.x, p.z) - s.major_radius, p.y) < s.minor_radius;
                        },
                        [&](const Quadric& s) { return function(s, p) < 0; },
                        [&](const Superellipsoid& s) { return function(s, p) < 0; },
                        [&](const std::shared_ptr<const Polygon>&) { return false; },
                        [&](const std::shared_ptr<const Csg>& csg) { return is_in_csg(*csg, p); },
                        [&](const auto& many_parts) { return geometry::is_inside(*many_parts, p); },
                    },
                    object.shape);
}

} // namespace

std::vector<double> real_zeros(const Polynomial& coefficients) {
  Polynomial p = coefficients;
  while (!p.empty() && p.back() == 0)
    p.pop_back();
  if (p.size() < 2) return {};
  // Between its extremes, and up to a bound of Cauchy's outside of them, it has one zero or none.
  double bound = 1;
  Polynomial derivative;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (i + 1 < p.size()) bound = std::max(bound, 1 + std::abs(p[i] / p.back()));
    if (i > 0) derivative.push_back(static_cast<double>(i) * p[i]);
  }
  std::vector<double> places = real_zeros(derivative), zeros;
  places.insert(places.begin(), -bound);
  places.push_back(bound);
  for (std::size_t i = 1; i < places.size(); ++i)
    if ((value(p, places[i - 1]) < 0) != (value(p, places[i]) < 0))
      zeros.push_back(zero_between(p, places[i - 1], places[i]));
  return zeros;
}

std::vector<double> crossings(const Object& object, const Vec3& origin, const Vec3& direction) {
  return std::visit(Overloaded{
                        [&](const Cylinder& s) { return frustum(s).crossings(origin, direction); },
                        [&](const Cone& s) { return frustum(s).crossings(origin, direction); },
                        [&](const std::shared_ptr<const Mesh>&) { return std::vector<double>(); },
                        [&](const std::shared_ptr<const Csg>&) { return std::vector<double>(); },
                        [&](const auto& s) { return cross(s, origin, direction); },
                    },
                    object.shape);
}

Vec3 local_normal(const Object& object, const Vec3& p) {
  return std::visit(Overloaded{
                        [&](const Sphere& s) { return p - s.centre; },
                        [&](const Plane& s) { return s.normal; },
                        [&](const Disc& s) { return s.normal; },
                        [&](const Box& s) {
                          Vec3 normal(0);
                          double nearest = HUGE_VAL;
                          for (int i = 0; i < 3; ++i)
                            for (const double side : {low(s)[i], high(s)[i]})
                              if (std::abs(p[i] - side) < nearest) {
                                nearest = std::abs(p[i] - side);
                                normal = Vec3(0);
                                normal[i] = side == low(s)[i] ? -1 : 1;
                              }
                          return normal;
                        },
                        [&](const Cylinder& s) { return frustum(s).normal(p); },
                        [&](const Cone& s) { return frustum(s).normal(p); },
                        [&](const Torus& s) {
                          const Vec3 flat(p.x, 0, p.z);
                          return p - flat * (s.major_radius / glm::length(flat));
                        },
                        [&](const Quadric& s) { return gradient(s, p); },
                        [&](const Superellipsoid& s) { return gradient(s, p); },
                        [&](const std::shared_ptr<const Polygon>& s) {
                          const auto& loop = s->loops.at(0);
                          return glm::cross(loop.at(1) - loop.at(0), loop.at(2) - loop.at(0));
                        },
                        [&](const std::shared_ptr<const Mesh>&) { return Vec3(0); },
                        [&](const std::shared_ptr<const Csg>&) { return Vec3(0); },
                        [&](const auto& many_parts) { return normal_near(*many_parts, p); },
                    },
                    object.shape);
}

bool is_inside(const Object& object, const Vec3& point) {
  if (object.clipped_by)
    for (const Object& clip : *object.clipped_by)
      if (!is_inside(clip, point)) return false;
  return is_in_shape(object, object.transform.inverse().point(point)) != object.inverse;
}

} // namespace celltrace::reference
