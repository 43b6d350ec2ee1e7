#include "render/scenes.hpp"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace celltrace::test {

Material matte(const Vec3& rgb) {
  Material m;
  m.pigment.rgb = rgb;
  return m;
}

Material glass(const Vec3& rgb) {
  Material m;
  m.pigment.rgb = rgb;
  m.pigment.filter = 0.9;
  m.finish.diffuse = 0.1;
  m.finish.specular = 0.6;
  m.finish.roughness = 0.01;
  m.finish.reflection_min = m.finish.reflection_max = Vec3(0.1);
  return m;
}

Object sphere_at(const Vec3& centre, double radius, Index material, Index interior) {
  Object object;
  object.shape = Sphere{centre, radius};
  object.material = material;
  object.interior = interior;
  return object;
}

Mesh floor_mesh(float height, float half) {
  Mesh mesh;
  mesh.vertices = {
      {-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}};
  mesh.triangles.resize(2);
  const Index corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
  for (int t = 0; t < 2; ++t)
    for (int i = 0; i < 3; ++i)
      mesh.triangles[t].vertex[i] = corners[t][i];
  return mesh;
}

Mesh ball_mesh(int rings) {
  Mesh mesh;
  const int columns = 2 * rings;
  for (int ring = 0; ring <= rings; ++ring)
    for (int column = 0; column < columns; ++column) {
      const double polar = std::numbers::pi * ring / rings;
      const double azimuth = 2 * std::numbers::pi * column / columns;
      mesh.vertices.emplace_back(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                 std::sin(polar) * std::sin(azimuth));
    }
  mesh.normals = mesh.vertices;
  const auto vertex = [&](int ring, int column) {
    return static_cast<Index>(ring * columns + column % columns);
  };
  const auto add = [&](Index a, Index b, Index c) {
    mesh.triangles.push_back({{a, b, c}, {a, b, c}, {kNoIndex, kNoIndex, kNoIndex}});
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int column = 0; column < columns; ++column) {
      if (ring > 0) add(vertex(ring, column), vertex(ring, column + 1), vertex(ring + 1, column));
      if (ring + 1 < rings)
        add(vertex(ring, column + 1), vertex(ring + 1, column + 1), vertex(ring + 1, column));
    }
  return mesh;
}

Object mesh_object(Mesh mesh, Index material, Index interior) {
  Object object;
  object.shape = std::make_shared<const Mesh>(std::move(mesh));
  object.material = material;
  object.interior = interior;
  return object;
}

Object csg_object(Csg::Operation operation, std::vector<Object> parts) {
  auto made = std::make_shared<Csg>();
  made->operation = operation;
  made->parts = std::move(parts);
  Object object;
  object.shape = std::shared_ptr<const Csg>(made);
  return object;
}

Camera camera_at(const Vec3& from, const Vec3& to) {
  Camera camera;
  camera.location = from;
  camera.direction = glm::normalize(to - from);
  const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0), camera.direction));
  camera.up = glm::cross(camera.direction, right) * (2 * std::tan(std::numbers::pi / 6) * 0.75);
  camera.right = right * (2 * std::tan(std::numbers::pi / 6));
  return camera;
}

Camera orthographic_camera(const Vec3& from, const Vec3& to, double width) {
  Camera camera = camera_at(from, to);
  camera.kind = Camera::Kind::orthographic;
  camera.right = glm::normalize(camera.right) * width;
  camera.up = glm::normalize(camera.up) * (width * 0.75);
  return camera;
}

} // namespace celltrace::test
