#include "pov/object_queries.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "pov/patterns.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

using Operation = Csg::Operation;

/// Nearer crossings are the point that a ray starts at.
constexpr double kNearest = 1e-6;
constexpr double kFarthest = 1e7;
/// Of shapes, in all calls together.
constexpr std::uint64_t kMostTests = 10'000'000'000;

struct Ray {
  Vec3 origin, direction;
  Vec3 at(double t) const { return origin + direction * t; }
};

struct Crossing {
  double t;
  Vec3 normal; ///< of any length
};
using Crossings = std::vector<Crossing>;

// ---- Polynomials ----

double polynomial(const std::vector<double>& c, double t) {
  double value = 0;
  for (std::size_t i = c.size(); i-- > 0;)
    value = value * t + c[i];
  return value;
}

/// The real roots in a range, ascending: between those of the derivative there is at most one each.
std::vector<double> roots(const std::vector<double>& c, double from, double to) {
  if (c.size() < 2) return {};
  std::vector<double> derivative;
  for (std::size_t i = 1; i < c.size(); ++i)
    derivative.push_back(static_cast<double>(i) * c[i]);
  std::vector<double> ends = roots(derivative, from, to);
  ends.push_back(to);
  std::vector<double> result;
  double low = from;
  for (const double end : ends) {
    double high = end;
    const double at_low = polynomial(c, low), at_high = polynomial(c, high);
    if (at_low == 0 || at_low * at_high < 0) {
      double inside = low;
      for (int step = 0; step < 200 && at_low != 0; ++step) {
        const double middle = (inside + high) / 2;
        if (middle == inside || middle == high) break;
        (polynomial(c, middle) * at_low > 0 ? inside : high) = middle;
      }
      result.push_back(inside);
    }
    low = end;
  }
  return result;
}

// ---- Shapes: where a ray crosses them, whether a point is inside, and their boxes ----

struct Query {
  Session& session;
  const Location& where;
  std::uint64_t& tests;

  void count(std::uint64_t shapes) const {
    tests += shapes;
    if (tests > kMostTests) session.fail(where, "the scene asks too much about its objects");
  }
};

Extent everywhere() {
  return {Vec3(-1e10), Vec3(1e10)};
}

Extent around(const std::vector<Vec3>& points) {
  Extent extent{points.front(), points.front()};
  for (const Vec3& point : points)
    for (int axis = 0; axis < 3; ++axis) {
      extent.min[axis] = std::min(extent.min[axis], point[axis]);
      extent.max[axis] = std::max(extent.max[axis], point[axis]);
    }
  return extent;
}

bool is_everywhere(const Extent& extent) {
  return extent.min.x <= -1e10 || extent.min.y <= -1e10 || extent.min.z <= -1e10 || extent.max.x >= 1e10 ||
         extent.max.y >= 1e10 || extent.max.z >= 1e10;
}

double volume(const Extent& extent) {
  const Vec3 size = extent.max - extent.min;
  return size.x * size.y * size.z;
}

/// Around the box as it is then.
Extent moved(const Extent& extent, const Transform& transform) {
  if (is_everywhere(extent)) return extent;
  std::vector<Vec3> corners;
  for (int corner = 0; corner < 8; ++corner)
    corners.push_back(
        transform.point({corner & 1 ? extent.max.x : extent.min.x, corner & 2 ? extent.max.y : extent.min.y,
                         corner & 4 ? extent.max.z : extent.min.z}));
  return around(corners);
}

Extent common(const Extent& a, const Extent& b) {
  Extent result;
  for (int axis = 0; axis < 3; ++axis) {
    result.min[axis] = std::max(a.min[axis], b.min[axis]);
    result.max[axis] = std::max(std::min(a.max[axis], b.max[axis]), result.min[axis]);
  }
  return result;
}

/// Round things have POV-Ray's box of the box around them on their own axes: which way these are turned about
/// the round one's axis.
Extent round_extent(const Vec3& base, const Vec3& cap, double radius, double margin) {
  const Vec3 d = glm::normalize(cap - base);
  const double square = d.x * d.x + d.y * d.y;
  Vec3 across{1, 0, 0}, along{0, 1, 0};
  if (square > 0) {
    // The shortest turn of z to the axis, after one about z.
    const Vec3 x = Vec3(1, 0, 0) - (d + Vec3(0, 0, 1)) * (d.x / (1 + d.z));
    const Vec3 y = Vec3(0, 1, 0) - (d + Vec3(0, 0, 1)) * (d.y / (1 + d.z));
    const double cosine = 2 * d.x * d.y / square, sine = (d.y * d.y - d.x * d.x) / square;
    across = x * cosine + y * sine;
    along = x * -sine + y * cosine;
  }
  std::vector<Vec3> corners;
  for (int corner = 0; corner < 8; ++corner)
    corners.push_back((corner & 1 ? cap + d * margin : base - d * margin) +
                      across * (corner & 2 ? radius : -radius) + along * (corner & 4 ? radius : -radius));
  return around(corners);
}

// Each shape in its own space, without its transformation.

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
  return everywhere();
}

void cross(const Disc& disc, const Ray& ray, Crossings& found) {
  const double length = glm::length(disc.normal);
  if (length == 0) return;
  const Vec3 n = disc.normal / length;
  const double slope = glm::dot(n, ray.direction);
  if (slope == 0) return;
  const double t = glm::dot(n, disc.centre - ray.origin) / slope;
  const double distance = glm::length(ray.at(t) - disc.centre);
  if (distance <= disc.radius && distance >= disc.hole_radius) found.push_back({t, n});
}
bool contains(const Disc& disc, const Vec3& p) {
  return glm::dot(disc.normal, p - disc.centre) < 0;
}
Extent extent(const Disc& disc) {
  constexpr double kThickness = 0.001;
  if (glm::length(disc.normal) == 0) return {disc.centre, disc.centre};
  const Vec3 n = glm::normalize(disc.normal) * kThickness;
  return round_extent(disc.centre - n, disc.centre + n, disc.radius, 0);
}

Box ordered(const Box& box) {
  return {{glm::min(box.corner[0], box.corner[1]), glm::max(box.corner[0], box.corner[1])}};
}
void cross(const Box& box, const Ray& ray, Crossings& found) {
  const Box b = ordered(box);
  double enter = -kFarthest * kFarthest, leave = kFarthest * kFarthest;
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

/// A cylinder is a cone, too.
void cross(const Cone& cone, const Ray& ray, Crossings& found) {
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
bool contains(const Cone& cone, const Vec3& p) {
  const Vec3 axis = cone.cap - cone.base;
  const double length = glm::length(axis), height = glm::dot(p - cone.base, axis) / length;
  if (height < 0 || height > length) return false;
  const double radius = cone.base_radius + (cone.cap_radius - cone.base_radius) * height / length;
  return glm::length(p - cone.base - axis * (height / length)) < radius;
}
Extent extent(const Cone& cone) {
  return round_extent(cone.base, cone.cap, std::max(cone.base_radius, cone.cap_radius), 0);
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
Extent extent(const Cylinder& c) {
  return extent(as_cone(c));
}

double torus_value(const Torus& torus, const Vec3& p) {
  const double ring = std::sqrt(p.x * p.x + p.z * p.z) - torus.major_radius;
  return ring * ring + p.y * p.y - torus.minor_radius * torus.minor_radius;
}
void cross(const Torus& torus, const Ray& ray, Crossings& found) {
  // From where the ray is nearest to the centre, for precision.
  const double length = glm::length(ray.direction);
  const Vec3 d = ray.direction / length;
  const double middle = -glm::dot(ray.origin, d);
  const Vec3 o = ray.origin + d * middle;
  const double reach = std::fabs(torus.major_radius) + std::fabs(torus.minor_radius);
  if (glm::dot(o, o) > reach * reach) return;
  const double R = torus.major_radius * torus.major_radius, r = torus.minor_radius * torus.minor_radius;
  const double k = glm::dot(o, o) + R - r;
  // (t^2 + k)^2 = 4 R (x^2 + z^2)
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
/// Of an ellipsoid along the axes.
Extent extent(const Quadric& q) {
  const bool is_ellipsoid = q.mixed == Vec3(0) && q.square.x > 0 && q.square.y > 0 && q.square.z > 0;
  if (!is_ellipsoid) return everywhere();
  const Vec3 centre = q.linear / (q.square * -2.0);
  const double level = glm::dot(q.square, centre * centre) - q.constant;
  if (level < 0) return {centre, centre};
  const Vec3 half = glm::sqrt(Vec3(level) / q.square);
  return {centre - half, centre + half};
}

struct Corners {
  Vec3 vertex[3];
  Vec3 normal[3];
  bool is_smooth = false;
};

void cross(const Corners& triangle, const Ray& ray, Crossings& found) {
  const Vec3 e1 = triangle.vertex[1] - triangle.vertex[0], e2 = triangle.vertex[2] - triangle.vertex[0];
  const Vec3 plane = glm::cross(e1, e2);
  const double volume = -glm::dot(ray.direction, plane);
  if (volume == 0) return;
  const Vec3 offset = ray.origin - triangle.vertex[0];
  const Vec3 moment = glm::cross(offset, ray.direction);
  const double u = glm::dot(e2, moment) / volume, v = -glm::dot(e1, moment) / volume;
  if (u < 0 || v < 0 || u + v > 1) return;
  const Vec3 normal = triangle.is_smooth
                          ? triangle.normal[0] * (1 - u - v) + triangle.normal[1] * u + triangle.normal[2] * v
                          : -plane;
  found.push_back({glm::dot(offset, plane) / volume, normal});
}

Corners corners_of(const Mesh& mesh, const Mesh::Triangle& triangle) {
  Corners corners;
  const Index* n = triangle.normal;
  corners.is_smooth = n[0] != kNoIndex && !(n[0] == n[1] && n[0] == n[2]);
  for (int i = 0; i < 3; ++i) {
    corners.vertex[i] = Vec3(mesh.vertices[triangle.vertex[i]]);
    if (corners.is_smooth) corners.normal[i] = glm::normalize(Vec3(mesh.normals[n[i]]));
  }
  return corners;
}

Corners corners_of(const TriangleDefinition& triangle) {
  Corners corners;
  corners.is_smooth = triangle.is_smooth;
  for (std::size_t i = 0; i < 3; ++i) {
    corners.vertex[i] = triangle.vertices[i];
    corners.normal[i] = triangle.normals[i];
  }
  return corners;
}

void cross(const Query& query, const Mesh& mesh, const Ray& ray, Crossings& found) {
  query.count(mesh.triangles.size());
  for (const Mesh::Triangle& triangle : mesh.triangles)
    cross(corners_of(mesh, triangle), ray, found);
}

bool contains(const Query& query, const Mesh& mesh, const Vec3& p) {
  if (!mesh.has_inside()) return false;
  Crossings found;
  cross(query, mesh, {p, mesh.inside_vector}, found);
  return std::count_if(found.begin(), found.end(), [](const Crossing& c) { return c.t > 0; }) % 2 == 1;
}

Extent extent(const Mesh& mesh) {
  if (mesh.vertices.empty()) return {};
  std::vector<Vec3> points(mesh.vertices.begin(), mesh.vertices.end());
  return around(points);
}

// ---- Objects ----

const Mesh* mesh_of(const Query& query, const ObjectDefinition& object) {
  const auto* mesh = std::get_if<std::shared_ptr<MeshDefinition>>(&object.shape);
  return mesh ? &query.session.builder.mesh_of(*mesh) : nullptr;
}

const Compound* compound_of(const ObjectDefinition& object) {
  const auto* compound = std::get_if<std::shared_ptr<const Compound>>(&object.shape);
  return compound ? compound->get() : nullptr;
}

/// Whether there is a shape to ask.
bool is_solid(const Query& query, const ObjectDefinition& object) {
  return query.session.diagnostics.supports(object.missing, query.where) &&
         !std::holds_alternative<LightDefinition>(object.shape);
}

ObjectDefinition limiting(const Limit& limit) {
  ObjectDefinition object = *limit.object;
  object.apply(limit.transform);
  return object;
}

Transform back(const Query& query, const ObjectDefinition& object) {
  if (is_singular(object.transform))
    query.session.fail(query.where, "this object's transformation is singular: it has no inverse");
  return object.transform.inverse();
}

bool contains(const Query& query, const ObjectDefinition& object, const Vec3& point);

bool contains(const Query& query, const Compound& compound, const Vec3& p) {
  const auto has = [&](const ObjectPtr& part) { return is_solid(query, *part) && contains(query, *part, p); };
  const auto& parts = compound.parts;
  if (compound.operation == Operation::intersection)
    return std::all_of(parts.begin(), parts.end(),
                       [&](const ObjectPtr& part) { return !is_solid(query, *part) || has(part); });
  if (compound.operation == Operation::difference)
    return has(parts.front()) && std::none_of(parts.begin() + 1, parts.end(), has);
  return std::any_of(parts.begin(), parts.end(), has);
}

bool contains(const Query& query, const ObjectDefinition& object, const Vec3& point) {
  query.count(1);
  for (const Limit& limit : object.clipped_by)
    if (!contains(query, limiting(limit), point)) return false;
  const Vec3 p = back(query, object).point(point);
  bool is_inside = false;
  if (const Compound* compound = compound_of(object))
    is_inside = contains(query, *compound, p);
  else if (const Mesh* mesh = mesh_of(query, object))
    is_inside = contains(query, *mesh, p);
  else if (const auto* shape = std::get_if<Shape>(&object.shape))
    is_inside = std::visit(
        [&](const auto& s) {
          if constexpr (requires { contains(s, p); })
            return contains(s, p);
          else
            return false;
        },
        *shape);
  return is_inside != object.inverse;
}

void cross(const Query& query, const ObjectDefinition& object, const Ray& ray, Crossings& found);

/// Of the surfaces of all parts, those that are the whole's.
void cross(const Query& query, const Compound& compound, const Ray& ray, Crossings& found) {
  const auto& parts = compound.parts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!is_solid(query, *parts[i])) continue;
    const bool is_taken_away = compound.operation == Operation::difference && i > 0;
    Crossings own;
    cross(query, *parts[i], ray, own);
    for (Crossing& crossing : own) {
      if (is_taken_away) crossing.normal = -crossing.normal;
      bool is_surface = true;
      for (std::size_t j = 0; j < parts.size() && is_surface && compound.operation != Operation::union_;
           ++j) {
        if (j == i || !is_solid(query, *parts[j])) continue;
        const bool is_inside = contains(query, *parts[j], ray.at(crossing.t));
        const bool must_be_inside = compound.operation == Operation::intersection ||
                                    (compound.operation == Operation::difference && j == 0);
        is_surface = is_inside == must_be_inside;
      }
      if (is_surface) found.push_back(crossing);
    }
  }
}

void cross(const Query& query, const ObjectDefinition& object, const Ray& ray, Crossings& found) {
  query.count(1);
  const Transform inverse = back(query, object);
  const Ray local{inverse.point(ray.origin), inverse.direction(ray.direction)};
  Crossings own;
  if (const Compound* compound = compound_of(object))
    cross(query, *compound, local, own);
  else if (const Mesh* mesh = mesh_of(query, object))
    cross(query, *mesh, local, own);
  else if (const auto* triangle = std::get_if<std::shared_ptr<TriangleDefinition>>(&object.shape))
    cross(corners_of(**triangle), local, own);
  else if (const auto* shape = std::get_if<Shape>(&object.shape))
    std::visit(
        [&](const auto& s) {
          if constexpr (requires { cross(s, local, own); }) cross(s, local, own);
        },
        *shape);
  std::vector<ObjectDefinition> clips;
  for (const Limit& limit : object.clipped_by)
    clips.push_back(limiting(limit));
  for (Crossing& crossing : own) {
    if (!(crossing.t > kNearest && crossing.t < kFarthest)) continue;
    const Vec3 point = ray.at(crossing.t);
    if (!std::all_of(clips.begin(), clips.end(),
                     [&](const ObjectDefinition& clip) { return contains(query, clip, point); }))
      continue;
    crossing.normal = object.transform.normal(crossing.normal);
    if (object.inverse) crossing.normal = -crossing.normal;
    found.push_back(crossing);
  }
}

Extent extent(const Query& query, const ObjectDefinition& object);

/// The half space of a plane along an axis, where it is a part of an intersection.
Extent half_space(const Plane& plane, const ObjectDefinition& object, bool is_inverse) {
  Extent result = everywhere();
  if (is_singular(object.transform)) return result;
  Vec3 normal = glm::normalize(object.transform.normal(plane.normal));
  const Vec3 point = object.transform.point(glm::normalize(plane.normal) * plane.distance);
  if (is_inverse) normal = -normal;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::fabs(std::fabs(normal[axis]) - 1) > 1e-10) continue;
    (normal[axis] > 0 ? result.max : result.min)[axis] = point[axis];
  }
  return result;
}

Extent extent(const Query& query, const Compound& compound) {
  std::vector<Extent> extents;
  for (std::size_t i = 0; i < compound.parts.size(); ++i) {
    const ObjectDefinition& part = *compound.parts[i];
    if (!query.session.diagnostics.supports(part.missing, query.where)) continue;
    if (compound.operation != Operation::intersection && compound.operation != Operation::difference) {
      extents.push_back(extent(query, part));
      continue;
    }
    const bool is_inverse = part.inverse != (compound.operation == Operation::difference && i > 0);
    const auto* shape = std::get_if<Shape>(&part.shape);
    const auto* plane = shape ? std::get_if<Plane>(shape) : nullptr;
    if (plane)
      extents.push_back(half_space(*plane, part, is_inverse));
    else if (!is_inverse)
      extents.push_back(extent(query, part));
  }
  if (extents.empty()) return everywhere();
  Extent result = extents.front();
  for (const Extent& one : extents)
    if (compound.operation == Operation::intersection || compound.operation == Operation::difference)
      result = common(result, one);
    else
      result = {glm::min(result.min, one.min), glm::max(result.max, one.max)};
  return result;
}

/// Of a sphere that only turns and grows along the axes, the tightest one.
std::optional<Extent> ellipsoid_extent(const ObjectDefinition& object) {
  const auto* shape = std::get_if<Shape>(&object.shape);
  const auto* sphere = shape ? std::get_if<Sphere>(shape) : nullptr;
  if (!sphere) return std::nullopt;
  const Vec3* rows = object.transform.rows;
  Vec3 column[3];
  for (int i = 0; i < 3; ++i)
    column[i] = {rows[0][i], rows[1][i], rows[2][i]};
  const auto is_askew = [](const Vec3& a, const Vec3& b) {
    return std::fabs(glm::dot(a, b)) > 1e-9 * glm::length(a) * glm::length(b);
  };
  if (is_askew(column[0], column[1]) || is_askew(column[0], column[2]) || is_askew(column[1], column[2]))
    return std::nullopt;
  const Vec3 centre = object.transform.point(sphere->centre);
  const Vec3 half = Vec3(glm::length(column[0]), glm::length(column[1]), glm::length(column[2])) *
                    std::fabs(sphere->radius);
  return Extent{centre - half, centre + half};
}

Extent extent(const Query& query, const ObjectDefinition& object) {
  query.count(1);
  if (!query.session.diagnostics.supports(object.missing, query.where)) return {};
  Extent result = everywhere();
  if (const std::optional<Extent> ellipsoid = ellipsoid_extent(object)) {
    result = *ellipsoid;
  } else {
    if (const Compound* compound = compound_of(object))
      result = extent(query, *compound);
    else if (const Mesh* mesh = mesh_of(query, object))
      result = extent(*mesh);
    else if (const auto* triangle = std::get_if<std::shared_ptr<TriangleDefinition>>(&object.shape))
      result = around({(*triangle)->vertices.begin(), (*triangle)->vertices.end()});
    else if (const auto* shape = std::get_if<Shape>(&object.shape))
      result = std::visit(
          [&](const auto& s) {
            if constexpr (requires { extent(s); })
              return extent(s);
            else
              return everywhere();
          },
          *shape);
    result = moved(result, object.transform);
  }
  // What limits it bounds it, too, if that is smaller.
  for (const auto* limits : {&object.clipped_by, &object.bounded_by})
    for (const Limit& limit : *limits) {
      if (limit.object->inverse) continue;
      const Extent other = extent(query, limiting(limit));
      if (volume(other) < volume(result)) result = other;
    }
  return result;
}

} // namespace

std::optional<ObjectHit> trace(Session& session, const ObjectDefinition& object, const Vec3& origin,
                               const Vec3& direction, const Location& where) {
  const double length = glm::length(direction);
  if (!(length > 0)) return std::nullopt;
  const Query query{session, where, session.shape_tests};
  if (!is_solid(query, object)) return std::nullopt;
  Crossings found;
  const Ray ray{origin, direction / length};
  cross(query, object, ray, found);
  const auto nearest = std::min_element(found.begin(), found.end(),
                                        [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
  if (nearest == found.end()) return std::nullopt;
  const double size = glm::length(nearest->normal);
  const Vec3 normal = size > 0 ? nearest->normal / size : nearest->normal;
  return ObjectHit{ray.at(nearest->t), normal + Vec3(0)}; // without negative zeros
}

bool contains(Session& session, const ObjectDefinition& object, const Vec3& point, const Location& where) {
  const Query query{session, where, session.shape_tests};
  return is_solid(query, object) && contains(query, object, point);
}

Extent extent_of(Session& session, const ObjectDefinition& object, const Location& where) {
  return extent({session, where, session.shape_tests}, object);
}

} // namespace celltrace::pov
