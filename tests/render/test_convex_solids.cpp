// What CSG makes of planes and boxes becomes boxes or meshes, where that is convex.
#include "records/object.hpp"
#include "render/scenes.hpp"
#include "scene_image/csg_parts.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

using namespace celltrace;
using test::csg_object;

namespace {

constexpr auto kIntersection = Csg::Operation::intersection;

Object plane(const Vec3& normal, double distance, Index material = 0) {
  Object object;
  object.shape = Plane{normal, distance};
  object.material = material;
  return object;
}

Object box(const Vec3& from, const Vec3& to, Index material = 0) {
  Object object;
  object.shape = Box{{from, to}};
  object.material = material;
  return object;
}

std::vector<CsgPart> parts_of(Object object, const std::vector<std::uint32_t>& material_flags = {0, 0}) {
  Scene scene;
  scene.objects.push_back(std::move(object));
  return CsgParts(scene, Eye(scene.camera), {}, 1, material_flags).parts;
}

const Mesh& only_mesh(const std::vector<CsgPart>& parts) {
  REQUIRE(parts.size() == 1);
  CHECK(!parts[0].is_limited());
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&parts[0].object.shape);
  REQUIRE(mesh != nullptr);
  return **mesh;
}

/// Closed: each edge is passed once in either direction.
void check_closed(const Mesh& mesh) {
  std::map<std::pair<Index, Index>, int> passed;
  for (const Mesh::Triangle& triangle : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      ++passed[{triangle.vertex[i], triangle.vertex[(i + 1) % 3]}];
  for (const auto& [edge, times] : passed) {
    CHECK(times == 1);
    CHECK(passed.contains({edge.second, edge.first}));
  }
}

/// As normals of flat triangles point.
Vec3 normal_of(const Mesh& mesh, const Mesh::Triangle& triangle) {
  const Vec3 a(mesh.vertices[triangle.vertex[0]]), b(mesh.vertices[triangle.vertex[1]]),
      c(mesh.vertices[triangle.vertex[2]]);
  return -glm::cross(b - a, c - a);
}

} // namespace

TEST_CASE("An octahedron of planes is a closed mesh with normals that point outward") {
  std::vector<Object> planes;
  for (int i = 0; i < 8; ++i)
    planes.push_back(plane({(i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1}, 1));
  Object object = csg_object(kIntersection, planes);
  object.transform = Transform::rotate({10, 20, 30}).then(Transform::translate({5, 0, 0}));
  const std::vector<CsgPart> parts = parts_of(object);
  const Mesh& mesh = only_mesh(parts);
  CHECK(mesh.vertices.size() == 6);
  CHECK(mesh.triangles.size() == 8);
  check_closed(mesh);
  for (const Mesh::Triangle& triangle : mesh.triangles)
    CHECK(glm::dot(normal_of(mesh, triangle), Vec3(mesh.vertices[triangle.vertex[0]]) - Vec3(5, 0, 0)) > 0);
}

TEST_CASE("A face of a mesh has the material of its plane, and of planes at one place that of the last") {
  const auto count = [](const Mesh& mesh, Index material) {
    return std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                         [&](const Mesh::Triangle& triangle) { return triangle.material[2] == material; });
  };
  Object object =
      csg_object(Csg::Operation::difference, {box({-1, -1, -1}, {1, 1, 1}), plane({1, 1, 1}, -1.2, 1)});
  const std::vector<CsgPart> cut = parts_of(object);
  check_closed(only_mesh(cut));
  CHECK(count(only_mesh(cut), 1) == 1); // the corner that is cut off
  CHECK(count(only_mesh(cut), 0) == 3 * 2 + 3 * 3);

  const std::vector<CsgPart> coincident = parts_of(
      csg_object(kIntersection, {plane({0, 1, 0}, 1), box({-1, -1, -1}, {1, 1, 1}), plane({0, 2, 0}, 1, 1)}));
  CHECK(count(only_mesh(coincident), 1) == 2);
  CHECK(count(only_mesh(coincident), 0) == 10);
}

TEST_CASE("What boxes and planes leave of a box is a box") {
  Object object = csg_object(kIntersection,
                             {box({0, 0, 0}, {2, 2, 2}), box({1, -1, -1}, {3, 3, 1}), plane({0, 1, 0}, 1)});
  object.transform = Transform::rotate({0, 45, 0});
  const std::vector<CsgPart> parts = parts_of(object);
  REQUIRE(parts.size() == 1);
  CHECK(!parts[0].is_limited());
  const Object& left = parts[0].object;
  REQUIRE(std::holds_alternative<Box>(left.shape));
  CHECK(std::get<Box>(left.shape).corner[0] == Vec3(0));
  CHECK(std::get<Box>(left.shape).corner[1] == Vec3(1));
  // A corner of either may be the first.
  const Vec3 middle = object.transform.inverse().point(left.transform.point(Vec3(0.5)));
  CHECK(glm::distance(middle, Vec3(1.5, 0.5, 0.5)) < 1e-9);
  for (const Vec3& edge : left.transform.rows)
    if (&edge != &left.transform.rows[3]) CHECK(glm::length(edge) == Approx(1));
}

TEST_CASE("What is not convex, not closed, or asks for more than points stays as it is") {
  const Object cube = box({-1, -1, -1}, {1, 1, 1}), slanted = plane({1, 1, 1}, 0.5);
  const auto are_limited = [](const std::vector<CsgPart>& parts) {
    return !parts.empty() &&
           std::all_of(parts.begin(), parts.end(), [](const CsgPart& part) { return part.is_limited(); });
  };
  Object other = slanted;
  other.no_shadow = true; // of no effect in an intersection
  CHECK(!are_limited(parts_of(csg_object(kIntersection, {cube, other}))));
  other.interior = 0;
  CHECK(are_limited(parts_of(csg_object(kIntersection, {cube, other}))));
  other.interior = cube.interior;
  other.light_group = 0;
  CHECK(are_limited(parts_of(csg_object(kIntersection, {cube, other}))));

  CHECK(are_limited(parts_of(csg_object(Csg::Operation::difference, {slanted, cube}))));
  CHECK(are_limited(parts_of(csg_object(Csg::Operation::merge, {slanted, cube}))));
  CHECK(are_limited(
      parts_of(csg_object(kIntersection, {slanted, plane({-1, 0, 0}, 1), plane({0, -1, 0}, 1)}))));
  CHECK(are_limited(parts_of(csg_object(kIntersection, {cube, test::sphere_at({0, 0, 0}, 1, 0, kNoIndex)}))));
  CHECK(are_limited(
      parts_of(csg_object(kIntersection, {cube, plane({0, 1, 0}, 0.5), plane({0, -1, 0}, -0.5)}))));
  CHECK(are_limited(parts_of(csg_object(kIntersection, {box({-1, 0, -1}, {1, 0, 1}), slanted}))));
  CHECK(parts_of(csg_object(kIntersection, {cube, plane({0, 1, 0}, -2)})).empty()); // beside the cube
  CHECK(are_limited(parts_of(csg_object(kIntersection, {cube, plane({0, 0, 0}, 1)}))));

  CHECK(!are_limited(parts_of(csg_object(kIntersection, {cube, slanted}))));
  CHECK(are_limited(parts_of(csg_object(kIntersection, {cube, slanted}), {kernel::object_flag::two_sided})));
  CHECK(are_limited(parts_of(csg_object(kIntersection, {cube, slanted}), {kernel::object_flag::by_surface})));
}

TEST_CASE("A box that a plane does not cut is that box, or nothing") {
  const Object whole = csg_object(kIntersection, {box({0, 0, 0}, {1, 2, 3}), plane({1, 1, 1}, 10)});
  const std::vector<CsgPart> parts = parts_of(whole);
  REQUIRE(parts.size() == 1);
  REQUIRE(std::holds_alternative<Box>(parts[0].object.shape));
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
    const Vec3 from = parts[0].object.transform.point(at);
    CHECK((from.x == Approx(0).margin(1e-9) || from.x == Approx(1)));
    CHECK((from.y == Approx(0).margin(1e-9) || from.y == Approx(2)));
    CHECK((from.z == Approx(0).margin(1e-9) || from.z == Approx(3)));
  }
  Object turned = csg_object(kIntersection, {plane({1, 1, 1}, -1), box({0, 0, 0}, {1, 2, 3})});
  turned.transform = Transform::rotate({10, 20, 30});
  CHECK(parts_of(turned).empty());
  // Touched by a plane it is not whole for sure, but looks so.
  CHECK(parts_of(csg_object(kIntersection, {box({0, 0, 0}, {1, 1, 1}), plane({1, 0, 0}, 1)})).size() == 1);
}
