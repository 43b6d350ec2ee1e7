// Triangles and meshes in double precision, beside what every triangle says by itself.
#include "geometry/mesh_geometry.hpp"
#include "geometry/triangle_tree.hpp"
#include "geometry/triangles.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

using namespace celltrace;
using namespace celltrace::geometry;

namespace {

class Random {
public:
  Vec3 point(double size) { return Vec3(number(), number(), number()) * size; }
  double number() { return uniform_(generator_); }

private:
  std::mt19937 generator_{7};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

void add_triangle(Mesh& mesh, const Vec3 (&corners)[3]) {
  Mesh::Triangle triangle;
  for (int i = 0; i < 3; ++i) {
    triangle.vertex[i] = static_cast<Index>(mesh.vertices.size());
    triangle.normal[i] = kNoIndex;
    mesh.vertices.emplace_back(corners[i]);
  }
  mesh.triangles.push_back(triangle);
}

/// Small triangles all over a cube.
Mesh scattered(int count) {
  Random random;
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 centre = random.point(2);
    add_triangle(mesh, {centre + random.point(0.2), centre + random.point(0.2), centre + random.point(0.2)});
  }
  return mesh;
}

/// Two pyramids on one square.
Mesh octahedron() {
  Mesh mesh;
  const Vec3 around[4] = {{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}};
  for (int i = 0; i < 4; ++i)
    for (const double top : {1.0, -1.0})
      add_triangle(mesh, {around[i], around[(i + 1) % 4], Vec3(0, top, 0)});
  mesh.inside_vector = {0.1, 1, 0.2};
  return mesh;
}

} // namespace

TEST_CASE("Rays cross triangles where their corners' weights say") {
  Random random;
  int hits = 0;
  for (int number = 0; number < 2000; ++number) {
    const std::array<Vec3, 3> corners = {random.point(1), random.point(1), random.point(1)};
    const double first = random.number() + 0.5, second = random.number() + 0.5, third = 1 - first - second;
    const bool is_in = first >= 0 && second >= 0 && third >= 0;
    const Vec3 target = corners[0] * first + corners[1] * second + corners[2] * third;
    const Vec3 origin = random.point(3);
    const double t = 2 * random.number();
    if (std::min({std::abs(first), std::abs(second), std::abs(third), std::abs(t)}) < 0.01) continue;
    const Ray ray{origin, (target - origin) / t};
    const Vec3 normals[3] = {random.point(1), random.point(1), random.point(1)};
    Crossings flat, smooth;
    cross_triangle(corners, nullptr, ray, flat);
    cross_triangle(corners, normals, ray, smooth);
    REQUIRE(flat.size() == (is_in ? 1u : 0u));
    REQUIRE(smooth.size() == flat.size());
    if (!is_in) continue;
    ++hits;
    CHECK(flat[0].t == Approx(t).epsilon(1e-6));
    CHECK(smooth[0].t == flat[0].t);
    const Vec3 outside = -glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    CHECK(glm::distance(glm::normalize(flat[0].normal), outside) < 1e-9);
    CHECK(glm::distance(smooth[0].normal, normals[0] * first + normals[1] * second + normals[2] * third) <
          1e-6);
  }
  CHECK(hits > 200);
  Crossings found;
  cross_triangle({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, nullptr, {{0.2, 0.2, 1}, {1, 0, 0}}, found);
  CHECK(found.empty());
}

TEST_CASE("A mesh's tree finds what rays cross, and little else") {
  for (const int count : {0, 1, 4, 5, 600}) {
    CAPTURE(count);
    const Mesh mesh = scattered(count);
    const TriangleTree tree(mesh);
    Random random;
    std::size_t found_in_all = 0, crossed_in_all = 0;
    for (int number = 0; number < 300; ++number) {
      Ray ray{random.point(3), random.point(1)};
      if (number % 4 == 0) ray.direction[number / 4 % 3] = 0;
      if (number % 8 == 0) {
        const int axis = number / 8 % 3;
        ray.direction = Vec3(0);
        ray.direction[axis] = -1;
      }
      const std::vector<std::uint32_t> along = tree.along(ray);
      CHECK(std::is_sorted(along.begin(), along.end()));
      CHECK(std::adjacent_find(along.begin(), along.end()) == along.end());
      found_in_all += along.size();
      Crossings all, found;
      find_crossings(mesh, ray, all);
      find_crossings(mesh, along, ray, found);
      crossed_in_all += all.size();
      REQUIRE(found.size() == all.size());
      for (std::size_t i = 0; i < all.size(); ++i)
        CHECK(found[i].t == all[i].t);
    }
    if (count < 600) continue;
    CHECK(crossed_in_all > 50);
    // Leaves have up to four triangles, whose boxes are about twice as large.
    CHECK(found_in_all < 30 * 300);
  }
}

TEST_CASE("Points are inside a closed mesh") {
  const Mesh mesh = octahedron();
  const TriangleTree tree(mesh);
  Mesh open = mesh;
  open.inside_vector = Vec3(0);
  Random random;
  int inside = 0;
  for (int number = 0; number < 1000; ++number) {
    const Vec3 p = random.point(1);
    const double sum = std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
    if (std::abs(sum - 1) < 1e-6) continue;
    inside += sum < 1;
    CHECK(is_inside(mesh, p) == (sum < 1));
    CHECK(is_inside(mesh, tree.along({p, mesh.inside_vector}), p) == (sum < 1));
    CHECK_FALSE(is_inside(open, p));
  }
  CHECK(inside > 50);
  const Extent extent = extent_of(mesh);
  CHECK(extent.min == Vec3(-1));
  CHECK(extent.max == Vec3(1));
  CHECK(extent_of(Mesh()).volume() == 0);
}

TEST_CASE("Triangles have an area unless their corners are on a line") {
  // Small integers, of which products are exact.
  const auto whole = [](const Vec3& point) { return Vec3f(glm::floor(point)); };
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const Vec3f corner = whole(random.point(50));
    const Vec3f edge = whole(random.point(20)), other = whole(random.point(20));
    CAPTURE(i, edge.x, edge.y, edge.z);
    const auto times = static_cast<float>(i % 7 - 3);
    CHECK_FALSE(has_area(corner, corner + edge, corner + times * edge));
    CHECK_FALSE(has_area(corner, corner + times * edge, corner + edge));
    CHECK(has_area(corner, corner + edge, corner + other) ==
          (glm::cross(Vec3(edge), Vec3(other)) != Vec3(0)));
  }
  // Each pair of axes.
  for (int axis = 0; axis < 3; ++axis) {
    Vec3f u(0), v(0);
    u[axis] = v[(axis + 1) % 3] = 1;
    CHECK(has_area(Vec3f(0), u, v));
    CHECK(has_area(Vec3f(7), u + 7.0f, v + 7.0f));
  }
  // Slim ones, where single precision leaves a doubt.
  CHECK(has_area({0, 0, 0}, {1, 1, 0}, {1, 1 + 1e-7f, 0}));
  CHECK(has_area({0, 0, 0}, {0, 1, 1}, {0, 1 + 2e-7f, 1}));
  CHECK(has_area({0, 0, 0}, {1, 0, 1}, {1 + 2e-7f, 0, 1}));
  CHECK(has_area({0, 0, 0}, {1e-20f, 0, 0}, {0, 1e-20f, 0}));
}
