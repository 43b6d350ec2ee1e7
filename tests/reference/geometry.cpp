#include "reference/geometry.hpp"

#include "reference/solids.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace celltrace::reference {

namespace {

using ObjectPtr = std::shared_ptr<const Object>;
using Condition = std::function<bool(const Vec3&)>;

Shape sphere_shape(const ObjectPtr& object, const Sphere& sphere) {
  Shape shape;
  shape.object = object;
  shape.sphere = sphere;
  shape.to_sphere = object->transform.inverse();
  for (Index& material : shape.material)
    material = object->material;
  return shape;
}

Shape solid_shape(const ObjectPtr& object) {
  Shape shape = sphere_shape(object, {});
  shape.solid = true;
  return shape;
}

Shape triangle_shape(const ObjectPtr& object, const Mesh& mesh, const Mesh::Triangle& triangle) {
  Shape shape;
  shape.object = object;
  shape.triangle = true;
  const Index* n = triangle.normal;
  shape.smooth = n[0] != kNoIndex && !(n[0] == n[1] && n[0] == n[2]);
  for (int i = 0; i < 3; ++i) {
    shape.vertex[i] = object->transform.point(Vec3(mesh.vertices[triangle.vertex[i]]));
    if (shape.smooth) shape.normal[i] = object->transform.normal(glm::normalize(Vec3(mesh.normals[n[i]])));
    shape.material[i] = triangle.material[i] == kNoIndex ? object->material : triangle.material[i];
    if (!mesh.coordinates.empty()) {
      const auto number = static_cast<std::size_t>(&triangle - mesh.triangles.data());
      const Vec2f at = mesh.coordinates[number].corner[i];
      shape.coordinates[i] = Vec3(at.x, at.y, 0);
    }
  }
  shape.blended = shape.material[0] != shape.material[1] || shape.material[0] != shape.material[2];
  return shape;
}

Crossings cross_sphere(const Shape& shape, const Ray& ray) {
  const Vec3 from_centre = shape.to_sphere.point(ray.origin) - shape.sphere.centre;
  const Vec3 direction = shape.to_sphere.direction(ray.direction);
  const double a = glm::dot(direction, direction);
  const double middle = -glm::dot(from_centre, direction) / a;
  const Vec3 nearest = from_centre + direction * middle;
  const double square = shape.sphere.radius * shape.sphere.radius - glm::dot(nearest, nearest);
  if (square < 0) return {};
  const double half = std::sqrt(square / a);
  return {2, {{middle - half}, {middle + half}}};
}

/// Cramer's rule on origin + t * direction = v0 + u * e1 + v * e2.
Crossings cross_triangle(const Shape& shape, const Ray& ray) {
  const Vec3 e1 = shape.vertex[1] - shape.vertex[0];
  const Vec3 e2 = shape.vertex[2] - shape.vertex[0];
  const Vec3 plane = glm::cross(e1, e2);
  const double volume = -glm::dot(ray.direction, plane);
  if (volume == 0) return {};
  const Vec3 offset = ray.origin - shape.vertex[0];
  const Vec3 moment = glm::cross(offset, ray.direction);
  const double u = glm::dot(e2, moment) / volume;
  const double v = -glm::dot(e1, moment) / volume;
  if (u < 0 || v < 0 || u + v > 1) return {};
  return {1, {{glm::dot(offset, plane) / volume, u, v}, {}}};
}

Crossings cross_solid(const Shape& shape, const Ray& ray) {
  std::vector<double> found =
      crossings(*shape.object, shape.to_sphere.point(ray.origin), shape.to_sphere.direction(ray.direction));
  std::sort(found.begin(), found.end());
  Crossings result;
  for (const double distance : found)
    if (result.count < 4) result.at[result.count++] = {distance};
  return result;
}

/// Takes objects apart that are placed in the world.
class TakenApart {
public:
  explicit TakenApart(std::vector<Shape>& shapes) : shapes_(shapes) {}

  /// `inverse`: what is around it turns its inside out.
  void add(const ObjectPtr& object, Condition condition, bool inverse) {
    if (object->clipped_by)
      condition = both(condition, [object](const Vec3& p) {
        return std::all_of(object->clipped_by->begin(), object->clipped_by->end(),
                           [&](const Object& clip) { return is_inside(clip, p); });
      });
    if (const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object->shape))
      return add_parts(*object, **csg, condition, inverse != object->inverse);
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object->shape)) {
      for (const Mesh::Triangle& triangle : (*mesh)->triangles)
        add(triangle_shape(object, **mesh, triangle), condition);
      return;
    }
    const auto* sphere = std::get_if<Sphere>(&object->shape);
    add(sphere != nullptr ? sphere_shape(object, *sphere) : solid_shape(object), condition);
  }

private:
  static Condition both(const Condition& a, const Condition& b) {
    if (!a) return b;
    return [a, b](const Vec3& p) { return a(p) && b(p); };
  }

  void add(Shape shape, const Condition& condition) {
    shape.condition = condition;
    shapes_.push_back(std::move(shape));
  }

  void add_parts(const Object& object, const Csg& csg, const Condition& condition, bool inverse) {
    using Operation = Csg::Operation;
    std::vector<ObjectPtr> parts;
    for (const Object& part : csg.parts) {
      auto placed = std::make_shared<Object>(part);
      place(*placed, object.transform);
      placed->no_shadow = placed->no_shadow || object.no_shadow;
      parts.push_back(placed);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const bool is_part_inverse = inverse != (csg.operation == Operation::difference && i > 0);
      if (csg.operation == Operation::union_ && !inverse) {
        add(parts[i], condition, is_part_inverse);
        continue;
      }
      // The surface is there where the other parts leave it to this one, whichever side is inside.
      add(parts[i],
          both(condition,
               [parts, i, operation = csg.operation](const Vec3& p) {
                 for (std::size_t other = 0; other < parts.size(); ++other) {
                   if (other == i) continue;
                   const bool is_taken = operation == Operation::difference && other > 0;
                   const bool fills =
                       operation == Operation::intersection || operation == Operation::difference;
                   if (is_inside(*parts[other], p) != (fills && !is_taken)) return false;
                 }
                 return true;
               }),
          is_part_inverse);
    }
  }

  static void place(Object& object, const Transform& next) {
    object.transform = object.transform.then(next);
    if (!object.clipped_by) return;
    auto clips = std::make_shared<std::vector<Object>>(*object.clipped_by);
    for (Object& clip : *clips)
      place(clip, next);
    object.clipped_by = std::move(clips);
  }

  std::vector<Shape>& shapes_;
};

} // namespace

std::vector<Shape> shapes_of(const Scene& scene) {
  std::vector<Shape> shapes;
  TakenApart apart(shapes);
  for (const Object& object : scene.objects)
    apart.add(ObjectPtr(ObjectPtr(), &object), nullptr, false);
  return shapes;
}

Crossings cross(const Shape& shape, const Ray& ray) {
  const Crossings all = shape.triangle ? cross_triangle(shape, ray)
                        : shape.solid  ? cross_solid(shape, ray)
                                       : cross_sphere(shape, ray);
  if (!shape.condition) return all;
  Crossings there;
  for (const Crossing& crossing : all)
    if (shape.condition(ray.origin + crossing.distance * ray.direction)) there.at[there.count++] = crossing;
  return there;
}

Vec3 normal_at(const Shape& shape, const Vec3& point, const Crossing& crossing) {
  if (shape.solid)
    return glm::normalize(
        shape.object->transform.normal(local_normal(*shape.object, shape.to_sphere.point(point))));
  if (!shape.triangle)
    return glm::normalize(shape.object->transform.normal(shape.to_sphere.point(point) - shape.sphere.centre));
  if (!shape.smooth)
    return glm::normalize(glm::cross(shape.vertex[1] - shape.vertex[0], shape.vertex[2] - shape.vertex[0]));
  return glm::normalize(shape.normal[0] * (1 - crossing.u - crossing.v) + shape.normal[1] * crossing.u +
                        shape.normal[2] * crossing.v);
}

namespace {

double turns(double y, double x) {
  const double angle = std::atan2(y, x) / (2 * std::numbers::pi);
  return angle < 0 ? angle + 1 : angle;
}

// Points of a shape, in the space that it is written in.

Vec3 coordinates_on(const Sphere& sphere, const Vec3& local, const Vec3&) {
  const Vec3 p = glm::normalize(local - sphere.centre);
  return {turns(p.z, p.x), 0.5 + std::asin(p.y) / std::numbers::pi, 0};
}
Vec3 coordinates_on(const Box& box, const Vec3& local, const Vec3&) {
  const Vec3 low = glm::min(box.corner[0], box.corner[1]), high = glm::max(box.corner[0], box.corner[1]);
  const Vec3 p = (local - low) / (high - low);
  const Vec3 off = glm::abs(p - Vec3(0.5));
  if (off.x >= off.y && off.x >= off.z) return {p.x < 0.5 ? p.z / 4 : 0.75 - p.z / 4, (1 + p.y) / 3, 0};
  if (off.y >= off.z) return {0.25 + p.x / 4, p.y < 0.5 ? p.z / 3 : 1 - p.z / 3, 0};
  return {p.z < 0.5 ? 1 - p.x / 4 : 0.25 + p.x / 4, (1 + p.y) / 3, 0};
}
Vec3 coordinates_on(const Torus& torus, const Vec3& p, const Vec3&) {
  return {0.5 - std::atan2(p.z, p.x) / (2 * std::numbers::pi),
          0.5 + std::atan2(p.y, std::hypot(p.x, p.z) - torus.major_radius) / (2 * std::numbers::pi), 0};
}
template <class Other> Vec3 coordinates_on(const Other&, const Vec3&, const Vec3& world) {
  return {world.x, world.y, 0};
}

} // namespace

Vec3 coordinates_at(const Shape& shape, const Vec3& point, const Crossing& crossing) {
  if (shape.triangle)
    return shape.coordinates[0] * (1 - crossing.u - crossing.v) + shape.coordinates[1] * crossing.u +
           shape.coordinates[2] * crossing.v;
  const Vec3 local = shape.object->transform.inverse().point(point);
  return std::visit([&](const auto& of) { return coordinates_on(of, local, point); }, shape.object->shape);
}

bool contains(const Shape& shape, const Vec3& point) {
  if (shape.triangle || shape.condition) return false;
  if (shape.solid) return is_inside(*shape.object, point);
  const Vec3 local = shape.to_sphere.point(point) - shape.sphere.centre;
  return glm::dot(local, local) < shape.sphere.radius * shape.sphere.radius;
}

} // namespace celltrace::reference
