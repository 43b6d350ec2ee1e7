// What is inside of meshes, against shapes that they look like and against all their triangles, one by one,
// in double precision.
#include "kernel/primitives/csg.hpp"
#include "lanes.hpp"
#include "render/scenes.hpp"
#include "scene_image/scene_image.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// A mesh as a part of CSG, whose inside can be asked.
class Solid {
public:
  explicit Solid(const Mesh& mesh, const Transform& transform = {})
      : image_(scene_of(mesh, transform)),
        scene_(spu_, CacheConfig::off(), reinterpret_cast<std::uintptr_t>(image_.base())) {}

  /// A bit a point; of 16.
  std::uint32_t inside(const VectorLanes& points) {
    const std::uint32_t all = (1u << kSimdLanes) - 1;
    const auto loaded = points.load<Simd>();
    return inside_solid(scene_, image_.header().solid_offset, loaded, loaded, all);
  }
  bool inside(const Vec3& point) {
    VectorLanes points;
    for (unsigned lane = 0; lane < kSimdLanes; ++lane)
      set(points, lane, point);
    const std::uint32_t bits = inside(points);
    CHECK((bits == 0 || bits == (1u << kSimdLanes) - 1));
    return bits != 0;
  }
  const ImageHeader& header() const { return image_.header(); }
  const SolidRecord& record() const {
    return *reinterpret_cast<const SolidRecord*>(image_.base() + header().solid_offset);
  }

private:
  static Scene scene_of(const Mesh& mesh, const Transform& transform) {
    Scene scene;
    scene.add(matte({1, 1, 1}));
    scene.add(Interior{});
    Object part = mesh_object(mesh, 0, 0);
    part.transform = transform;
    Object csg;
    csg.shape = std::make_shared<const Csg>(
        Csg{Csg::Operation::intersection, {part, sphere_at({0, 0, 0}, 100, 0, 0)}});
    scene.objects = {csg};
    return scene;
  }

  SceneImage image_;
  DirectSpu spu_;
  SceneAccess<DirectSpu> scene_;
};

void add_triangle(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto first = static_cast<Index>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {Vec3f(a), Vec3f(b), Vec3f(c)});
  mesh.triangles.push_back({{first, first + 1, first + 2}});
}

/// From -1 to 1, each side of n x n squares, whose triangles share nothing but the coordinates of vertices.
Mesh cube_mesh(int n) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            Vec3 at;
            at[axis] = side;
            at[(axis + 1) % 3] = 2.0 * (i + di) / n - 1;
            at[(axis + 2) % 3] = 2.0 * (j + dj) / n - 1;
            return at;
          };
          add_triangle(mesh, corner(0, 0), corner(1, 0), corner(1, 1));
          add_triangle(mesh, corner(0, 0), corner(1, 1), corner(0, 1));
        }
  return mesh;
}

Transform random_transform(Random& random) {
  return Transform::scale({random.uniform(0.3, 3), random.uniform(0.3, 3), random.uniform(-3, -0.3)})
      .then(Transform::rotate(random.point(180)))
      .then(Transform::translate(random.point(5)));
}

/// Whether a triangle is above a point. `is_close` becomes true if rounding may decide that.
bool is_above(const Vec3& from, const Vec3& along, const Vec3 (&corner)[3], bool& is_close) {
  const Vec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], p = glm::cross(along, e2);
  const double determinant = glm::dot(e1, p);
  const Vec3 s = from - corner[0], q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / determinant, v = glm::dot(along, q) / determinant;
  const double distance = glm::dot(e2, q) / determinant;
  constexpr double kClose = 1e-3;
  const double least = std::min({u, v, 1 - u - v});
  const bool is_steep = std::abs(determinant) < kClose * glm::length(glm::cross(e1, e2));
  if (least > -kClose && (least < kClose || std::abs(distance) < kClose || is_steep)) is_close = true;
  return least > 0 && distance > 0;
}

} // namespace

TEST_CASE("A ball of triangles has the inside of a ball, however it is placed") {
  Random random(3);
  for (int round = 0; round < times(48); ++round) {
    Mesh mesh = ball_mesh(3 + static_cast<int>(random.below(20)));
    mesh.inside_vector = random.direction() * std::pow(10, random.uniform(-300, 300));
    const double in = std::pow(std::cos(3.15 / static_cast<double>(std::sqrt(mesh.triangles.size()))), 2);
    const Transform transform = round == 0 ? Transform() : random_transform(random);
    Solid solid(mesh, transform);
    for (int i = 0; i < 40; ++i) {
      VectorLanes points;
      for (unsigned lane = 0; lane < kSimdLanes; ++lane)
        set(points, lane, transform.point(random.direction() * random.uniform(0, 1.4)));
      const std::uint32_t inside = solid.inside(points);
      for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
        const double radius = glm::length(transform.inverse().point(at(points, lane)));
        INFO("round " << round << ", radius " << radius << ", " << mesh.triangles.size() << " triangles");
        if (radius < in - 0.01) CHECK((inside >> lane & 1) == 1);
        if (radius > 1.001) CHECK((inside >> lane & 1) == 0);
      }
    }
  }
}

TEST_CASE("Points above edges and corners that triangles share count once") {
  for (const Vec3& along : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0, 2, 0), Vec3(-1, 0, 0), Vec3(1, 1, 1),
                            Vec3(1, 0, 1), Vec3(0.3, -0.4, 0.5)}) {
    for (int n : {1, 2, 3, 4, 8}) {
      INFO("along " << along.x << ' ' << along.y << ' ' << along.z << ", " << n);
      Mesh mesh = cube_mesh(n);
      mesh.inside_vector = along;
      Solid solid(mesh);
      int wrong = 0;
      // All that lie on the planes of the squares, on their diagonals, and between.
      for (int x = -10; x <= 10; ++x)
        for (int y = -10; y <= 10; ++y)
          for (int z = -10; z <= 10; ++z) {
            const int largest = std::max({std::abs(x), std::abs(y), std::abs(z)});
            if (largest == 8) continue; // on the surface
            wrong += solid.inside(Vec3(x, y, z) / 8.0) != (largest < 8);
          }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("Points that have a vertex or an edge above them are where they seem") {
  Random random(5);
  int wrong = 0;
  for (int round = 0; round < times(32); ++round) {
    Mesh mesh = ball_mesh(12);
    mesh.inside_vector = random.direction();
    const Transform transform = round % 2 == 0 ? Transform() : random_transform(random);
    Solid solid(mesh, transform);
    for (int i = 0; i < 400; ++i) {
      const Mesh::Triangle& triangle =
          mesh.triangles[random.below(static_cast<unsigned>(mesh.triangles.size()))];
      const Vec3 a(mesh.vertices[triangle.vertex[0]]), b(mesh.vertices[triangle.vertex[1]]);
      const Vec3 above = a + (b - a) * (i % 4 == 0 ? 0.0 : random.uniform(0, 1));
      const Vec3 point = above - mesh.inside_vector * random.uniform(-2.5, 2.5);
      const double radius = glm::length(point);
      if (radius < 0.95) wrong += !solid.inside(transform.point(point));
      if (radius > 1.01) wrong += solid.inside(transform.point(point));
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("Of any triangles an odd number above a point make it inside") {
  Random random(7);
  for (int round = 0; round < times(32); ++round) {
    Mesh mesh;
    const double size = random.uniform(0.1, 1.5);
    for (unsigned i = 0; i < 1 + random.below(round % 2 == 0 ? 10 : 300); ++i) {
      const Vec3 at = random.point(1);
      add_triangle(mesh, at, at + random.point(size), at + random.point(size));
    }
    mesh.inside_vector = random.direction();
    Solid solid(mesh);
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
      VectorLanes points;
      for (unsigned lane = 0; lane < kSimdLanes; ++lane)
        set(points, lane, random.point(1.5));
      const std::uint32_t inside = solid.inside(points);
      for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
        bool odd = false, is_close = false;
        for (const Mesh::Triangle& triangle : mesh.triangles) {
          Vec3 corner[3];
          for (int k = 0; k < 3; ++k)
            corner[k] = Vec3(mesh.vertices[triangle.vertex[k]]);
          odd ^= is_above(at(points, lane), mesh.inside_vector, corner, is_close);
        }
        if (is_close) continue;
        ++compared;
        CHECK(odd == ((inside >> lane & 1) != 0));
      }
    }
    CHECK(compared > 100);
  }
}

TEST_CASE("Meshes that are no solids have no inside, and take no more memory than others") {
  SECTION("without an inside vector") {
    Solid solid(cube_mesh(2));
    CHECK(solid.record().object.kind_and_flags == kEmptySolid);
    CHECK(solid.header().mesh_triangle_count == 0);
    CHECK_FALSE(solid.inside(Vec3(0, 0, 0)));
  }
  SECTION("without triangles") {
    Mesh mesh;
    mesh.inside_vector = {1, 2, 3};
    CHECK_FALSE(Solid(mesh).inside(Vec3(0, 0, 0)));
  }
  SECTION("flat along the inside vector, and in a line") {
    Mesh mesh = floor_mesh(0, 1);
    mesh.inside_vector = {0.3, 0, 0.4};
    Solid flat(mesh);
    for (Vec3f& vertex : mesh.vertices)
      vertex = {vertex.x, 0, 0};
    Solid line(mesh);
    for (const Vec3& point : {Vec3(0, -0.1, 0), Vec3(0, 0.1, 0), Vec3(0.3, 1, 0.4)}) {
      CHECK_FALSE(flat.inside(point));
      CHECK_FALSE(line.inside(point));
    }
  }
  SECTION("of long thin triangles that lie across each other") {
    Mesh mesh;
    for (int i = 0; i < 5000; ++i) {
      const double angle = 0.001 * i;
      const Vec3 end(std::cos(angle), 0.001 * i, std::sin(angle));
      add_triangle(mesh, -end, end, end + Vec3(0.001, 0, 0.001));
    }
    mesh.inside_vector = {0, 1, 0};
    Solid solid(mesh);
    CHECK(solid.header().mesh_triangle_count == 5000);
    CHECK(solid.header().mesh_word_count <= 18 * 5000);
  }
  SECTION("far away and tiny") {
    Mesh mesh = cube_mesh(2);
    mesh.inside_vector = {0, 1, 0.2};
    const Transform far = Transform::scale(Vec3(1e-3)).then(Transform::translate({1000, 0, 0}));
    CHECK(Solid(mesh, far).inside(Vec3(1000, 0, 0)));
    CHECK_FALSE(Solid(mesh, far).inside(Vec3(1000.1, 0, 0)));
    CHECK_FALSE(Solid(mesh, far).inside(Vec3(-1e15, 1e15, 1e15)));
  }
}
