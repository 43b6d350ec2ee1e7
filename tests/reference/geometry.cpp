#include "reference/geometry.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace celltrace::reference {

namespace {

Shape sphere_shape(const Object& object, const Sphere& sphere) {
  Shape shape;
  shape.object = &object;
  shape.sphere = sphere;
  shape.to_sphere = object.transform.inverse();
  for (Index& material : shape.material)
    material = object.material;
  return shape;
}

Shape triangle_shape(const Object& object, const Mesh& mesh, const Mesh::Triangle& triangle) {
  Shape shape;
  shape.object = &object;
  shape.triangle = true;
  const Index* n = triangle.normal;
  shape.smooth = n[0] != kNoIndex && !(n[0] == n[1] && n[0] == n[2]);
  for (int i = 0; i < 3; ++i) {
    shape.vertex[i] = object.transform.point(Vec3(mesh.vertices[triangle.vertex[i]]));
    if (shape.smooth) shape.normal[i] = object.transform.normal(glm::normalize(Vec3(mesh.normals[n[i]])));
    shape.material[i] = triangle.material[i] == kNoIndex ? object.material : triangle.material[i];
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

} // namespace

std::vector<Shape> shapes_of(const Scene& scene) {
  std::vector<Shape> shapes;
  for (const Object& object : scene.objects) {
    if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
      shapes.push_back(sphere_shape(object, *sphere));
      continue;
    }
    const Mesh& mesh = *std::get<std::shared_ptr<const Mesh>>(object.shape);
    for (const Mesh::Triangle& triangle : mesh.triangles)
      shapes.push_back(triangle_shape(object, mesh, triangle));
  }
  return shapes;
}

Crossings cross(const Shape& shape, const Ray& ray) {
  return shape.triangle ? cross_triangle(shape, ray) : cross_sphere(shape, ray);
}

Vec3 normal_at(const Shape& shape, const Vec3& point, const Crossing& crossing) {
  if (!shape.triangle)
    return glm::normalize(shape.object->transform.normal(shape.to_sphere.point(point) - shape.sphere.centre));
  if (!shape.smooth)
    return glm::normalize(glm::cross(shape.vertex[1] - shape.vertex[0], shape.vertex[2] - shape.vertex[0]));
  return glm::normalize(shape.normal[0] * (1 - crossing.u - crossing.v) + shape.normal[1] * crossing.u +
                        shape.normal[2] * crossing.v);
}

bool contains(const Shape& shape, const Vec3& point) {
  if (shape.triangle) return false;
  const Vec3 local = shape.to_sphere.point(point) - shape.sphere.centre;
  return glm::dot(local, local) < shape.sphere.radius * shape.sphere.radius;
}

} // namespace celltrace::reference
