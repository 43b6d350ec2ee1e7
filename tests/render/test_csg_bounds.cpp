// Bounds of what CSG shows: tight enough for a BVH, and around all that can be seen.
#include "render/scenes.hpp"
#include "scene_image/csg_parts.hpp"
#include "scene_image/polytope.hpp"
#include "scene_image/quadric_bounds.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <variant>

using namespace celltrace;
using test::csg_object;

namespace {

Object plane(const Vec3& normal, double distance, bool inverse = false) {
  Object object;
  object.shape = Plane{normal, distance};
  object.inverse = inverse;
  return object;
}

/// With the parts in the order in which they are written, as their conditions are.
CsgParts parts_of(Object object) {
  Scene scene;
  scene.objects.push_back(std::move(object));
  CsgParts parts(scene, Eye(scene.camera));
  std::stable_sort(parts.parts.begin(), parts.parts.end(),
                   [](const CsgPart& a, const CsgPart& b) { return a.condition < b.condition; });
  return parts;
}

void check_bounds(const kernel::Aabb& box, const Vec3& min, const Vec3& max) {
  for (int i = 0; i < 3; ++i) {
    CHECK(box.min[i] == Approx(min[i]).margin(4e-3));
    CHECK(box.max[i] == Approx(max[i]).margin(4e-3));
  }
}

bool contains(const kernel::Aabb& box, const Vec3& point) {
  for (int i = 0; i < 3; ++i)
    if (point[i] < box.min[i] || point[i] > box.max[i]) return false;
  return true;
}

/// The eight planes of an octahedron with corners 1 from its centre.
std::vector<Object> octahedron() {
  std::vector<Object> planes;
  for (int i = 0; i < 8; ++i) {
    const Vec3 normal((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    // Every other one as the complement of the opposite half-space.
    planes.push_back(i % 2 == 0 ? plane(normal, std::sqrt(1.0 / 3))
                                : plane(-normal, -std::sqrt(1.0 / 3), true));
  }
  return planes;
}

Object box(const Vec3& from, const Vec3& to) {
  Object object;
  object.shape = Box{{from, to}};
  return object;
}

} // namespace

TEST_CASE("Slanted planes bound their intersection, and each its own face") {
  const CsgParts parts = parts_of(csg_object(Csg::Operation::intersection, octahedron()));
  REQUIRE(parts.parts.size() == 8);
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(parts.parts[i].is_bounded);
    const Vec3 side((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    check_bounds(parts.parts[i].bounds, glm::min(side, Vec3(0)), glm::max(side, Vec3(0)));
  }
}

TEST_CASE("Planes bound what they cut, through differences, transformations and nested intersections") {
  Object inner = csg_object(Csg::Operation::intersection, octahedron());
  inner.transform = Transform::scale({2, 2, 2}).then(Transform::translate({10, 0, 0}));
  Object cone = plane({0, 1, 0}, 0);
  cone.shape = Quadric{{1, -1, 1}, {}, {}, 0};
  cone.transform = Transform::translate({10, 0, 0});
  const CsgParts parts =
      parts_of(csg_object(Csg::Operation::difference, {inner, plane({1, 1, 0}, std::sqrt(50.0)), cone}));
  REQUIRE(parts.parts.size() == 10);
  for (const CsgPart& part : parts.parts)
    CHECK(part.is_bounded);
  // What x + y > 10 leaves of it.
  check_bounds(parts.parts[8].bounds, {9, -1, -2}, {11, 1, 2});
  check_bounds(parts.parts[9].bounds, {9, -1, -2}, {12, 2, 2});
}

TEST_CASE("Planes that leave space open are without bounds") {
  for (const int count : {1, 2, 3, 4}) {
    std::vector<Object> some = octahedron();
    some.resize(static_cast<std::size_t>(count));
    const CsgParts parts = parts_of(csg_object(Csg::Operation::intersection, some));
    bool all = true;
    for (const CsgPart& part : parts.parts)
      all = all && part.is_bounded;
    CHECK_FALSE(all);
  }
}

TEST_CASE("Planes that leave nothing show nothing") {
  std::vector<Object> planes = octahedron();
  planes.push_back(plane({1, 2, 3}, -2));
  CHECK(parts_of(csg_object(Csg::Operation::intersection, planes)).parts.empty());
}

TEST_CASE("Every point that is seen of planes is in the bounds of its plane") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return glm::normalize(Vec3(normal(random), normal(random), normal(random))); };
  for (int round = 0; round < 40; ++round) {
    const Vec3 centre = 10.0 * direction();
    std::vector<Vec3> normals;
    std::vector<Object> planes;
    // Doubled planes and planes that only touch an edge or a corner are among them.
    for (int i = 0; i < 4 + 3 * round; ++i) {
      normals.push_back(i % 7 == 6 ? normals.back() : direction());
      planes.push_back(plane(normals.back(), 1 + glm::dot(centre, normals.back())));
    }
    const CsgParts parts = parts_of(csg_object(Csg::Operation::intersection, planes));
    REQUIRE(parts.parts.size() == planes.size());
    int seen = 0;
    for (int ray = 0; ray < 400; ++ray) {
      const Vec3 toward = direction();
      double nearest = 1e6;
      std::size_t hit = normals.size();
      for (std::size_t i = 0; i < normals.size(); ++i) {
        const double slope = glm::dot(normals[i], toward);
        if (slope > 0 && 1 / slope < nearest) {
          nearest = 1 / slope;
          hit = i;
        }
      }
      if (hit == normals.size()) continue;
      ++seen;
      CHECK(contains(parts.parts[hit].bounds, centre + toward * nearest));
    }
    CHECK(seen > 100);
  }
}

TEST_CASE("An intersection of very many planes is soon taken apart") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<Object> planes;
  for (int i = 0; i < 3000; ++i)
    planes.push_back(plane({normal(random), normal(random), normal(random)}, 1));
  CHECK(parts_of(csg_object(Csg::Operation::intersection, planes)).parts.size() == 3000);
}

TEST_CASE("Quadrics between planes are bounded, and bound the planes") {
  Object cone = plane({0, 1, 0}, 0);
  cone.shape = Quadric{{1, -1, 1}, {}, {}, 0};
  Object inner = cone;
  inner.transform = Transform::scale({0.5, 1, 0.5});
  inner.inverse = true;
  Object paraboloid = cone;
  paraboloid.shape = Quadric{{1, 0, 1}, {}, {0, -1, 0}, 0};
  Object cup =
      csg_object(Csg::Operation::intersection,
                 {csg_object(Csg::Operation::intersection, {plane({0, 1, 0}, 2), cone, inner, paraboloid}),
                  plane({0, 1, 0}, 0, true)});

  SECTION("along the axes") {
    cup.transform = Transform::scale({3, 1, 3}).then(Transform::translate({10, 0, 0}));
    const CsgParts parts = parts_of(cup);
    REQUIRE(parts.parts.size() == 5);
    const double edge = 3 * std::sqrt(2.0);
    check_bounds(parts.parts[0].bounds, {10 - edge, 0, -edge}, {10 + edge, 2, edge});
    for (const CsgPart& part : parts.parts) {
      CHECK(part.is_bounded);
      CHECK(part.bounds.max[0] < 10.01 + edge);
    }
  }
  SECTION("turned as a whole") {
    cup.transform = Transform::rotate({30, 40, 50}).then(Transform::translate({10, 0, 0}));
    const CsgParts parts = parts_of(cup);
    REQUIRE(parts.parts.size() == 5);
    for (const CsgPart& part : parts.parts)
      for (int i = 0; i < 3; ++i) {
        INFO("part " << &part - parts.parts.data() << " axis " << i);
        // Corners of a box with edges of 2 sqrt(2), 2 and 2 sqrt(2) are within 3 of its ends.
        CHECK(part.bounds.min[i] > (i == 0 ? 10 : 0) - 3.0f);
        CHECK(part.bounds.max[i] < (i == 0 ? 10 : 0) + 3.0f);
      }
  }
}

TEST_CASE("Quadrics that nothing limits stay without bounds") {
  Object cone = plane({0, 1, 0}, 0);
  cone.shape = Quadric{{1, -1, 1}, {}, {}, 0};
  for (const Vec3& turn : {Vec3(0), Vec3(90, 0, 0), Vec3(30, 40, 50)}) {
    cone.transform = Transform::rotate(turn);
    const CsgParts parts = parts_of(csg_object(Csg::Operation::intersection, {plane({0, 1, 0}, 2), cone}));
    REQUIRE(parts.parts.size() == 2);
    CHECK_FALSE(parts.parts[0].is_bounded);
    CHECK_FALSE(parts.parts[1].is_bounded);
  }
}

TEST_CASE("All that a box has of a quadric is in the quadric's bounds") {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto any = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  const auto often_0 = [&](Vec3 v) {
    for (int i = 0; i < 3; ++i)
      if (random() % 3 == 0) v[i] = 0;
    return v;
  };
  int on_surface = 0, within_solid = 0, limited = 0;
  for (int round = 0; round < 3000; ++round) {
    const Quadric quadric{often_0(any()), random() % 2 == 0 ? Vec3(0) : often_0(any()), often_0(any()),
                          normal(random)};
    Transform transform = Transform::scale(glm::abs(any()) + 0.1).then(Transform::translate(any() * 3.0));
    if (random() % 2 == 0) transform = Transform::rotate(any() * 90.0).then(transform);
    const Transform inverse = transform.inverse();
    const auto value = [&](const Vec3& at) {
      const Vec3 p = inverse.point(at);
      return glm::dot(quadric.square, p * p) +
             glm::dot(quadric.mixed, Vec3(p.x * p.y, p.x * p.z, p.y * p.z)) + glm::dot(quadric.linear, p) +
             quadric.constant;
    };
    kernel::Aabb within;
    for (int i = 0; i < 3; ++i) {
      const double a = 4 * normal(random), b = 4 * normal(random);
      constexpr float kInfinite = std::numeric_limits<float>::max();
      within.min[i] = random() % 3 == 0 ? -kInfinite : static_cast<float>(std::min(a, b));
      within.max[i] = random() % 3 == 0 ? kInfinite : static_cast<float>(std::max(a, b));
    }
    const kernel::Aabb surface = bounds_of_quadric(quadric, transform, false, within);
    const kernel::Aabb solid = bounds_of_quadric(quadric, transform, true, within);
    for (int i = 0; i < 3; ++i)
      limited += surface.min[i] > within.min[i] || surface.max[i] < within.max[i];
    for (int line = 0; line < 30; ++line) {
      const Vec3 from = any() * 5.0, along = any() * 5.0;
      if (contains(within, from) && value(from) <= 0) {
        ++within_solid;
        CHECK(contains(solid, from));
      }
      // A parabola through three values along the line.
      const double c = value(from), plus = value(from + along), minus = value(from - along);
      const double a = (plus + minus) / 2 - c, b = (plus - minus) / 2, root = b * b - 4 * a * c;
      if (root < 0 || std::abs(a) < 1e-6) continue;
      for (const double sign : {-1.0, 1.0}) {
        const Vec3 at = from + along * ((-b + sign * std::sqrt(root)) / (2 * a));
        if (!contains(within, at)) continue;
        ++on_surface;
        CHECK(contains(surface, at));
      }
    }
  }
  CHECK(on_surface > 5000);
  CHECK(within_solid > 5000);
  CHECK(limited > 2000);
}

TEST_CASE("Boxes that are cut away bound what they leave, and show the faces of the cut alone") {
  Object cylinder;
  cylinder.shape = Cylinder{{0, 0, 0}, {0, 0, 1}, 2, false};
  Object quarter = csg_object(Csg::Operation::difference,
                              {cylinder, box({-3, 0, -1}, {3, 3, 2}), box({-3, -3, -1}, {0, 3, 2})});

  SECTION("along the axes") {
    const CsgParts parts = parts_of(quarter);
    REQUIRE(parts.parts.size() == 3);
    check_bounds(parts.parts[0].bounds, {0, -2, 0}, {2, 0, 1});
    check_bounds(parts.parts[1].bounds, {0, 0, 0}, {2, 0, 1});
    check_bounds(parts.parts[2].bounds, {0, -2, 0}, {0, 0, 1});
  }
  SECTION("turned by right angles") {
    quarter.transform = Transform::rotate({0, 0, 180}).then(Transform::rotate({90, 0, 0}));
    const CsgParts parts = parts_of(quarter);
    REQUIRE(parts.parts.size() == 3);
    check_bounds(parts.parts[0].bounds, {-2, -1, 0}, {0, 0, 2});
  }
  SECTION("but not where faces coincide: there those of what is cut away may be seen") {
    const CsgParts parts = parts_of(
        csg_object(Csg::Operation::difference, {box({-1, -1, -1}, {1, 1, 1}), box({-1, 0, -1}, {1, 1, 1})}));
    REQUIRE(parts.parts.size() == 2);
    check_bounds(parts.parts[0].bounds, {-1, -1, -1}, {1, 1, 1});
    check_bounds(parts.parts[1].bounds, {-1, 0, -1}, {1, 1, 1});
  }
  SECTION("unless they leave something on several sides") {
    const CsgParts parts = parts_of(
        csg_object(Csg::Operation::difference, {cylinder, box({-3, -1, -1}, {3, 1, 2}),
                                                box({1, 0, -1}, {3, 3, 2}), box({0, 0, 0.5}, {1, 1, 0.75})}));
    REQUIRE(parts.parts.size() == 4);
    check_bounds(parts.parts[0].bounds, {-2, -2, 0}, {2, 2, 1});
  }
  SECTION("to nothing") {
    CHECK(parts_of(csg_object(Csg::Operation::difference, {cylinder, box({-3, -3, -1}, {3, 3, 2})}))
              .parts.empty());
  }
}

TEST_CASE("Every point that is seen of boxes is in the bounds of its box") {
  std::mt19937 random(11);
  // On a small grid, so that faces often lie in one plane.
  const auto corner = [&] {
    const auto any = [&] { return static_cast<double>(random() % 5); };
    return Vec3(any(), any(), any());
  };
  std::uniform_real_distribution<double> within(0, 1);
  int seen = 0, smaller = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<Object> boxes;
    std::vector<std::pair<Vec3, Vec3>> corners;
    while (boxes.size() < 2 + random() % 4) {
      const Vec3 a = corner(), b = corner();
      if (a.x == b.x || a.y == b.y || a.z == b.z) continue;
      corners.emplace_back(glm::min(a, b), glm::max(a, b));
      boxes.push_back(box(a, b));
    }
    const bool difference = random() % 2 == 0;
    const CsgParts parts =
        parts_of(csg_object(difference ? Csg::Operation::difference : Csg::Operation::intersection, boxes));
    for (int sample = 0; sample < 300; ++sample) {
      const std::size_t own = random() % boxes.size();
      Vec3 at = corners[own].first + Vec3(within(random), within(random), within(random)) *
                                         (corners[own].second - corners[own].first);
      const int axis = static_cast<int>(random() % 3);
      at[axis] = random() % 2 == 0 ? corners[own].first[axis] : corners[own].second[axis];
      bool shows = true;
      for (std::size_t other = 0; other < boxes.size(); ++other) {
        if (other == own) continue;
        bool inside = true;
        for (int i = 0; i < 3; ++i)
          inside = inside && at[i] >= corners[other].first[i] && at[i] <= corners[other].second[i];
        shows = shows && inside == (!difference || other == 0);
      }
      if (!shows) continue;
      ++seen;
      // Parts that show nothing are left out; the others keep their order.
      bool contained = false;
      for (const CsgPart& part : parts.parts)
        contained =
            contained ||
            (std::get<Box>(part.object.shape).corner[0] == std::get<Box>(boxes[own].shape).corner[0] &&
             std::get<Box>(part.object.shape).corner[1] == std::get<Box>(boxes[own].shape).corner[1] &&
             contains(part.bounds, at));
      CHECK(contained);
    }
    for (const CsgPart& part : parts.parts)
      for (int i = 0; i < 3; ++i)
        smaller += part.bounds.max[i] - part.bounds.min[i] + 0.01f <
                   part.shape.bounds().max[i] - part.shape.bounds().min[i];
  }
  CHECK(seen > 3000);
  CHECK(smaller > 500);
}
