#include "python/extent.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace celltrace {

namespace {

using Points = std::vector<Vec3>;

/// Returns directions that cover the unit sphere evenly, by the golden angle.
Points directions(int count) {
  Points made;
  for (int i = 0; i < count; ++i) {
    const double y = 1 - (2.0 * i + 1) / count, radius = std::sqrt(1 - y * y);
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5));
    made.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
  }
  return made;
}

/// Collects points of one shape in its own space.
class ShapePoints {
public:
  ShapePoints(Points& to, const Points& directions) : to_(to), directions_(directions) {}

  void operator()(const Sphere& sphere) { add_ellipsoid(sphere.centre, Vec3(sphere.radius)); }
  void operator()(const Disc& disc) { add_circle(disc.centre, disc.normal, disc.radius); }
  void operator()(const Box& box) { add_box(box.corner[0], box.corner[1]); }
  void operator()(const Cylinder& cylinder) {
    add_circle(cylinder.base, cylinder.cap - cylinder.base, cylinder.radius);
    add_circle(cylinder.cap, cylinder.cap - cylinder.base, cylinder.radius);
  }
  void operator()(const Cone& cone) {
    add_circle(cone.base, cone.cap - cone.base, cone.base_radius);
    add_circle(cone.cap, cone.cap - cone.base, cone.cap_radius);
  }
  void operator()(const Torus& torus) {
    const Vec3 axis(0, 1, 0);
    add_circle(Vec3(0), axis, torus.major_radius + torus.minor_radius);
    for (const double side : {-1.0, 1.0})
      add_circle(side * torus.minor_radius * axis, axis, torus.major_radius);
  }
  /// Adds points of ellipsoids along the axes, the only quadrics that are bounded for sure.
  void operator()(const Quadric& quadric) {
    const Vec3 square = quadric.square;
    if (quadric.mixed != Vec3(0) || !(square.x > 0 && square.y > 0 && square.z > 0)) return;
    const Vec3 centre = -quadric.linear / (2.0 * square);
    const double level = glm::dot(square, centre * centre) - quadric.constant;
    if (level > 0) add_ellipsoid(centre, glm::sqrt(level / square));
  }
  void operator()(const Superellipsoid&) { add_box(Vec3(-1), Vec3(1)); }
  void operator()(const Plane&) {}
  void operator()(const std::shared_ptr<const Mesh>& mesh) {
    for (const Mesh::Triangle& triangle : mesh->triangles)
      for (const Index corner : triangle.vertex)
        if (corner < mesh->vertices.size()) to_.emplace_back(mesh->vertices[corner]);
  }
  void operator()(const std::shared_ptr<const Polygon>& polygon) {
    for (const std::vector<Vec3>& loop : polygon->loops)
      to_.insert(to_.end(), loop.begin(), loop.end());
  }
  void operator()(const std::shared_ptr<const Polynomial>&) {}
  void operator()(const std::shared_ptr<const Prism>& prism) {
    for (const double height : {prism->bottom, prism->top})
      for (const Vec3& p : curve_points(prism->outline)) {
        const double size = prism->is_conic ? height : 1;
        to_.emplace_back(p.x * size, height, p.y * size);
      }
  }
  void operator()(const std::shared_ptr<const Lathe>& lathe) {
    for (const Vec3& p : curve_points(lathe->curve))
      add_circle(Vec3(0, p.y, 0), Vec3(0, 1, 0), p.x);
  }
  void operator()(const std::shared_ptr<const SurfaceOfRevolution>& sor) {
    for (const SurfaceOfRevolution::Piece& piece : sor->pieces)
      for (int i = 0; i <= kSteps; ++i) {
        const double y = piece.low + (piece.high - piece.low) * i / kSteps;
        const double square =
            ((piece.square[3] * y + piece.square[2]) * y + piece.square[1]) * y + piece.square[0];
        add_circle(Vec3(0, y, 0), Vec3(0, 1, 0), std::sqrt(std::max(square, 0.0)));
      }
  }
  /// Adds points at the edge of each field, somewhat outside of the surface.
  void operator()(const std::shared_ptr<const Blob>& blob) {
    for (const Blob::Component& component : blob->components)
      if (component.strength > 0)
        for (const Vec3& direction : directions_)
          for (const Vec3& middle : {component.a, component.b})
            to_.push_back(component.transform.point(middle + direction * component.radius));
  }
  void operator()(const std::shared_ptr<const Csg>& csg);

private:
  static constexpr int kSteps = 8; ///< points on a piece of a curve, less one

  static Points curve_points(const std::vector<CurveSegment>& curve) {
    Points points;
    const auto at = [](const std::array<double, 4>& c, double w) {
      return ((c[3] * w + c[2]) * w + c[1]) * w + c[0];
    };
    for (const CurveSegment& segment : curve)
      for (int i = 0; i <= kSteps; ++i)
        points.emplace_back(at(segment.x, i / double{kSteps}), at(segment.y, i / double{kSteps}), 0);
    return points;
  }
  void add_box(const Vec3& a, const Vec3& b) {
    for (int i = 0; i < 8; ++i)
      to_.emplace_back(i & 1 ? a.x : b.x, i & 2 ? a.y : b.y, i & 4 ? a.z : b.z);
  }
  void add_ellipsoid(const Vec3& centre, const Vec3& radii) {
    for (const Vec3& direction : directions_)
      to_.push_back(centre + radii * direction);
  }
  void add_circle(const Vec3& centre, const Vec3& axis, double radius) {
    const Vec3 other = std::abs(axis.x) < std::abs(axis.y) ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 across = glm::cross(axis, other);
    if (!(glm::dot(across, across) > 0)) return;
    const Vec3 u = glm::normalize(across), v = glm::normalize(glm::cross(axis, u));
    constexpr int kPoints = 24;
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2 * std::numbers::pi * i / kPoints;
      to_.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }

  Points& to_;
  const Points& directions_;
};

Points points_of(const Object& object, const Points& directions) {
  Points points;
  if (object.inverse) return points;
  std::visit(ShapePoints(points, directions), object.shape);
  for (Vec3& point : points)
    point = object.transform.point(point);
  return points;
}

double volume_around(const Points& points) {
  Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& point : points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  const Vec3 size = high - low;
  return points.empty() ? std::numeric_limits<double>::infinity() : size.x * size.y * size.z;
}

/// Adds points of a CSG: an intersection lies in the smallest of its parts, a difference in its first one.
void ShapePoints::operator()(const std::shared_ptr<const Csg>& csg) {
  Points smallest;
  for (const Object& part : csg->parts) {
    const Points points = points_of(part, directions_);
    if (csg->operation == Csg::Operation::union_ || csg->operation == Csg::Operation::merge)
      to_.insert(to_.end(), points.begin(), points.end());
    else if (volume_around(points) < volume_around(smallest))
      smallest = points;
    if (csg->operation == Csg::Operation::difference) break;
  }
  to_.insert(to_.end(), smallest.begin(), smallest.end());
}

} // namespace

std::vector<Vec3> points_around(const Scene& scene) {
  constexpr std::size_t kMany = 1000;
  const Points around = directions(scene.objects.size() > kMany ? 32 : 200);
  Points all;
  for (const Object& object : scene.objects) {
    if (object.is_hidden || object.no_image) continue;
    const Points points = points_of(object, around);
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

} // namespace celltrace
