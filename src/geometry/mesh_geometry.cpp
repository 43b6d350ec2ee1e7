#include "geometry/mesh_geometry.hpp"

#include "geometry/triangles.hpp"

#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace celltrace::geometry {

namespace {

/// The place where a ray crosses a triangle, t times the ray's direction away: the first corner plus u times
/// the side to the second corner and v times the side to the third.
struct Place {
  double t, u, v;
};

std::optional<Place> place_on(const std::array<Vec3, 3>& corners, const Ray& ray) {
  const Vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
  const Vec3 plane = glm::cross(e1, e2);
  const double volume = -glm::dot(ray.direction, plane);
  if (volume == 0) return std::nullopt;
  const Vec3 offset = ray.origin - corners[0];
  const Vec3 moment = glm::cross(offset, ray.direction);
  const double u = glm::dot(e2, moment) / volume, v = -glm::dot(e1, moment) / volume;
  if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
  return Place{glm::dot(offset, plane) / volume, u, v};
}

std::array<Vec3, 3> corners_of(const Mesh& mesh, const Mesh::Triangle& triangle) {
  const Index* vertex = triangle.vertex;
  return {Vec3(mesh.vertices[vertex[0]]), Vec3(mesh.vertices[vertex[1]]), Vec3(mesh.vertices[vertex[2]])};
}

void cross(const Mesh& mesh, const Mesh::Triangle& triangle, const Ray& ray, Crossings& found) {
  const std::array<Vec3, 3> corners = corners_of(mesh, triangle);
  if (!is_smooth(triangle)) return cross_triangle(corners, nullptr, ray, found);
  Vec3 normals[3];
  for (int i = 0; i < 3; ++i)
    normals[i] = unit_normal(mesh.normals[triangle.normal[i]]);
  cross_triangle(corners, normals, ray, found);
}

bool is_ahead(const Mesh& mesh, const Mesh::Triangle& triangle, const Ray& ray) {
  const std::optional<Place> place = place_on(corners_of(mesh, triangle), ray);
  return place && place->t > 0;
}

} // namespace

void cross_triangle(const std::array<Vec3, 3>& corners, const Vec3* normals, const Ray& ray,
                    Crossings& found) {
  const std::optional<Place> place = place_on(corners, ray);
  if (!place) return;
  const auto [t, u, v] = *place;
  found.push_back({t, normals != nullptr ? normals[0] * (1 - u - v) + normals[1] * u + normals[2] * v
                                         : -glm::cross(corners[1] - corners[0], corners[2] - corners[0])});
}

void find_crossings(const Mesh& mesh, const Ray& ray, Crossings& found) {
  for (const Mesh::Triangle& triangle : mesh.triangles)
    cross(mesh, triangle, ray, found);
}

void find_crossings(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const Ray& ray,
                    Crossings& found) {
  for (const std::uint32_t triangle : triangles)
    cross(mesh, mesh.triangles[triangle], ray, found);
}

bool is_inside(const Mesh& mesh, const Vec3& point) {
  if (!mesh.has_inside()) return false;
  const Ray ray{point, mesh.inside_vector};
  bool inside = false;
  for (const Mesh::Triangle& triangle : mesh.triangles)
    inside ^= is_ahead(mesh, triangle, ray);
  return inside;
}

bool is_inside(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const Vec3& point) {
  if (!mesh.has_inside()) return false;
  const Ray ray{point, mesh.inside_vector};
  bool inside = false;
  for (const std::uint32_t triangle : triangles)
    inside ^= is_ahead(mesh, mesh.triangles[triangle], ray);
  return inside;
}

Extent extent_of(const Mesh& mesh) {
  if (mesh.triangles.empty()) return {};
  Vec3f low = mesh.vertices[mesh.triangles.front().vertex[0]], high = low;
  for (const Mesh::Triangle& triangle : mesh.triangles)
    for (const Index vertex : triangle.vertex) {
      low = glm::min(low, mesh.vertices[vertex]);
      high = glm::max(high, mesh.vertices[vertex]);
    }
  return {Vec3(low), Vec3(high)};
}

} // namespace celltrace::geometry
