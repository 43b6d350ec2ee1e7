// Crossings, insides and normals of shapes in double precision, beside each shape's equation.
#include "geometry/shape_geometry.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

using namespace celltrace;
using namespace celltrace::geometry;

namespace {

/// A shape, and a number that is negative inside of it, 0 on its surface and positive outside.
struct Sample {
  std::string name;
  Shape shape;
  std::function<double(const Vec3&)> value;
};

double cone_value(const Vec3& base, const Vec3& cap, double base_radius, double cap_radius, const Vec3& p) {
  const double length = glm::length(cap - base);
  const Vec3 axis = (cap - base) / length;
  const double height = glm::dot(p - base, axis);
  const double radius =
      std::abs(base_radius) * (1 - height / length) + std::abs(cap_radius) * height / length;
  return std::max({glm::length(p - base - axis * height) - radius, -height, height - length});
}

Sample box_sample(const std::string& name, const Vec3& a, const Vec3& b) {
  return {name, Box{{a, b}}, [=](const Vec3& p) {
            const Vec3 beyond = glm::max(glm::min(a, b) - p, p - glm::max(a, b));
            return std::max({beyond.x, beyond.y, beyond.z});
          }};
}
Sample cone_sample(const std::string& name, const Cone& cone) {
  return {name, cone, [=](const Vec3& p) {
            return cone_value(cone.base, cone.cap, cone.base_radius, cone.cap_radius, p);
          }};
}
Sample sphere_sample(const std::string& name, const Vec3& centre, double radius) {
  return {name, Sphere{centre, radius},
          [=](const Vec3& p) { return glm::length(p - centre) - std::abs(radius); }};
}
Sample torus_sample(const std::string& name, double major, double minor) {
  return {name, Torus{major, minor},
          [=](const Vec3& p) { return std::hypot(std::hypot(p.x, p.z) - major, p.y) - minor; }};
}
Sample quadric_sample(const std::string& name, const Quadric& q) {
  return {name, q, [=](const Vec3& p) {
            return q.square.x * p.x * p.x + q.square.y * p.y * p.y + q.square.z * p.z * p.z +
                   q.mixed.x * p.x * p.y + q.mixed.y * p.x * p.z + q.mixed.z * p.y * p.z + q.linear.x * p.x +
                   q.linear.y * p.y + q.linear.z * p.z + q.constant;
          }};
}
Sample superellipsoid_sample(const std::string& name, double east_west, double north_south) {
  return {name, Superellipsoid{east_west, north_south}, [=](const Vec3& p) {
            const double across =
                std::pow(std::abs(p.x), 2 / east_west) + std::pow(std::abs(p.y), 2 / east_west);
            return std::pow(across, east_west / north_south) + std::pow(std::abs(p.z), 2 / north_south) - 1;
          }};
}

std::vector<Sample> samples() {
  Quadric saddle;
  saddle.square = {1, -1, 0};
  saddle.linear = {0.2, 0, -1};
  Quadric askew;
  askew.square = {1, 2, 1.5};
  askew.mixed = {0.5, -0.3, 0.7};
  askew.linear = {0.1, 0.2, -0.3};
  askew.constant = -1;
  Quadric slab; // parallel planes
  slab.square = {0, 1, 0};
  slab.constant = -0.5;
  return {
      sphere_sample("sphere", {0.3, -0.2, 0.1}, 1.1),
      sphere_sample("sphere of negative radius", {0, 0.5, 0}, -0.8),
      box_sample("box", {-1, -0.5, -0.25}, {0.5, 0.75, 1}),
      box_sample("box of swapped corners", {1, -1, 0.5}, {-1, 0, -0.5}),
      cone_sample("cone", {{0, -1, 0}, {0.3, 1, 0.2}, 1, 0.25, false}),
      cone_sample("cone that widens", {{0, -1, 0}, {-0.3, 1, 0.5}, 0.25, 0.9, false}),
      cone_sample("cone with a tip", {{-1, 0, 0}, {1, 0, 0}, 0.8, 0, false}),
      cone_sample("cone of negative radii", {{0, 0, -1}, {0, 0.2, 1}, -0.5, -1, false}),
      {"cylinder", Cylinder{{-0.5, -1, 0}, {0.5, 1, 0.5}, 0.7, false},
       [](const Vec3& p) {
         return cone_value({-0.5, -1, 0}, {0.5, 1, 0.5}, 0.7, 0.7, p);
       }},
      torus_sample("torus", 1, 0.3),
      torus_sample("thick torus", 0.8, 0.7),
      quadric_sample("saddle", saddle),
      quadric_sample("askew quadric", askew),
      quadric_sample("slab", slab),
      superellipsoid_sample("superellipsoid", 0.5, 0.7),
      superellipsoid_sample("rounded superellipsoid", 1.3, 1.1),
      {"plane", Plane{{1, 2, -0.5}, 0.3},
       [](const Vec3& p) { return glm::dot(glm::normalize(Vec3(1, 2, -0.5)), p) - 0.3; }},
  };
}

class RandomRays {
public:
  /// Toward the middle of the shapes, from anywhere and of any length; every fifth along an axis.
  Ray next() {
    const Vec3 from = point(3), to = point(0.8);
    Ray ray{from, (to - from) * std::exp2(uniform_(generator_))};
    if (++count_ % 5 != 0) return ray;
    const int axis = count_ / 5 % 3;
    ray.direction = Vec3(0);
    ray.direction[axis] = uniform_(generator_) < 0 ? -1 : 2;
    ray.origin = to - ray.direction * 2.0;
    return ray;
  }
  Vec3 point(double size) {
    return Vec3(uniform_(generator_), uniform_(generator_), uniform_(generator_)) * size;
  }

private:
  std::mt19937 generator_{1};
  std::uniform_real_distribution<double> uniform_{-1, 1};
  int count_ = 0;
};

Vec3 gradient(const Sample& sample, const Vec3& p) {
  constexpr double kStep = 1e-6;
  Vec3 result(0);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 step(0);
    step[axis] = kStep;
    result[axis] = (sample.value(p + step) - sample.value(p - step)) / (2 * kStep);
  }
  return result;
}

} // namespace

TEST_CASE("Rays cross shapes where their equations say") {
  for (const Sample& sample : samples()) {
    INFO(sample.name);
    RandomRays rays;
    int crossings = 0, smooth = 0;
    for (int number = 0; number < 400; ++number) {
      const Ray ray = rays.next();
      Crossings found;
      find_crossings(sample.shape, ray, found);
      for (const Crossing& crossing : found) {
        const Vec3 p = ray.at(crossing.t);
        if (glm::length(p) > 20) continue; // of shapes without bounds
        ++crossings;
        if (std::abs(sample.value(p)) > 1e-5) CHECK(sample.value(p) == 0);
        const Vec3 slope = gradient(sample, p);
        // At edges the equation has no slope.
        if (std::abs(sample.value(p + glm::normalize(slope) * 1e-4)) < 1e-6) continue;
        const double along = glm::dot(glm::normalize(slope), glm::normalize(crossing.normal));
        smooth += along > 0.999;
      }
      // None is found twice.
      Crossings sorted = found;
      std::sort(sorted.begin(), sorted.end(), [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
      CHECK(std::adjacent_find(sorted.begin(), sorted.end(), [](const Crossing& a, const Crossing& b) {
              return b.t - a.t < 1e-9;
            }) == sorted.end());
      // As often between two points as they are on different sides, or twice as often.
      const double length = glm::length(ray.direction);
      constexpr int kSteps = 200;
      for (int step = 0; step < kSteps; ++step) {
        const double from = step * 8.0 / kSteps / length, to = (step + 1) * 8.0 / kSteps / length;
        const double a = sample.value(ray.at(from)), b = sample.value(ray.at(to));
        if (std::min(std::abs(a), std::abs(b)) < 1e-4) continue;
        const auto between = std::count_if(found.begin(), found.end(), [&](const Crossing& crossing) {
          return crossing.t >= from && crossing.t < to;
        });
        if (((a < 0) != (b < 0)) != (between % 2 != 0)) {
          CAPTURE(ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
                  ray.direction.z);
          CHECK(((a < 0) != (b < 0)) == (between % 2 != 0));
        }
      }
    }
    CHECK(crossings > 300);
    CHECK(smooth > 0.97 * crossings);
  }
}

TEST_CASE("Points are inside shapes where their equations say") {
  for (const Sample& sample : samples()) {
    INFO(sample.name);
    RandomRays points;
    int inside = 0;
    for (int number = 0; number < 2000; ++number) {
      const Vec3 p = points.point(1.5);
      const double value = sample.value(p);
      if (std::abs(value) < 1e-6) continue;
      inside += value < 0;
      if (is_inside(sample.shape, p) != (value < 0)) {
        CAPTURE(p.x, p.y, p.z, value);
        CHECK(is_inside(sample.shape, p) == (value < 0));
      }
    }
    CHECK(inside > 50);
    CHECK(inside < 1950);
  }
}

TEST_CASE("Extents hold all crossings") {
  const Transform placed = Transform::rotate({20, 30, 40})
                               .then(Transform::scale({1, 2, 0.5}))
                               .then(Transform::translate({3, 4, 5}));
  for (const Sample& sample : samples()) {
    INFO(sample.name);
    for (const Transform& transform : {Transform(), placed}) {
      const Extent extent = extent_of(sample.shape, transform);
      if (extent.is_everywhere()) continue;
      Vec3 low = extent.max, high = extent.min;
      RandomRays rays;
      for (int number = 0; number < 3000; ++number) {
        const Ray ray = rays.next();
        Crossings found;
        find_crossings(sample.shape, ray, found);
        for (const Crossing& crossing : found) {
          const Vec3 p = transform.point(ray.at(crossing.t));
          low = glm::min(low, p);
          high = glm::max(high, p);
        }
      }
      for (int axis = 0; axis < 3; ++axis) {
        CAPTURE(axis);
        CHECK(low[axis] >= extent.min[axis] - 1e-6);
        CHECK(high[axis] <= extent.max[axis] + 1e-6);
        // What is moved has a box around its box.
        const double loose = transform.is_identity() ? 0.4 : 0.9;
        CHECK(high[axis] - low[axis] > (1 - loose) * (extent.max[axis] - extent.min[axis]));
      }
    }
  }
}

TEST_CASE("Open cones and cylinders have no ends") {
  const Cone cone{{0.1, -1, 0}, {0.3, 1, 0.2}, 1, 0.25, true};
  const Cylinder cylinder{{-0.5, -1, 0}, {0.5, 1, 0.5}, 0.7, true};
  for (const auto& [open, axis] : {std::pair<Shape, Vec3>{cone, cone.cap - cone.base},
                                   std::pair<Shape, Vec3>{cylinder, cylinder.cap - cylinder.base}}) {
    Shape closed = open;
    if (auto* const round = std::get_if<Cone>(&closed)) round->open = false;
    if (auto* const round = std::get_if<Cylinder>(&closed)) round->open = false;
    RandomRays rays;
    int ends = 0;
    for (int number = 0; number < 500; ++number) {
      const Ray ray = rays.next();
      Crossings all, sides;
      find_crossings(closed, ray, all);
      find_crossings(open, ray, sides);
      const auto is_end = [&, axis = axis](const Crossing& crossing) {
        return std::abs(glm::dot(glm::normalize(crossing.normal), glm::normalize(axis))) > 1 - 1e-9;
      };
      ends += static_cast<int>(std::count_if(all.begin(), all.end(), is_end));
      all.erase(std::remove_if(all.begin(), all.end(), is_end), all.end());
      REQUIRE(sides.size() == all.size());
      for (std::size_t i = 0; i < all.size(); ++i)
        CHECK(sides[i].t == all[i].t);
    }
    CHECK(ends > 100);
    // A ray across the axis meets no end.
    Crossings found;
    const Vec3 across = glm::cross(axis, Vec3(0, 0, 1));
    find_crossings(closed, {Vec3(0, 0, 0.05) - across, across}, found);
    CHECK(found.size() == 2);
  }
}

TEST_CASE("Discs have a rim, a hole and two sides") {
  const Disc disc{{0, 1, 0}, {0, 2, 0}, 2, 0.5};
  const auto crossings = [&](double x, double slope) {
    Crossings found;
    find_crossings(disc, {{x, 3, 0}, {0, slope, 0}}, found);
    return found;
  };
  for (const double x : {0.0, 0.49, -0.49, 2.01, -2.01})
    CHECK(crossings(x, -1).empty());
  for (const double x : {0.5, 0.51, -1.9, 2.0}) {
    REQUIRE(crossings(x, -2).size() == 1);
    CHECK(crossings(x, -2)[0].t == 1);
    CHECK(crossings(x, -2)[0].normal == Vec3(0, 1, 0));
    CHECK(crossings(x, 4)[0].t == -0.5);
    CHECK(crossings(x, 1)[0].t == -2);
  }
  CHECK(crossings(1, 0).empty());
  CHECK(is_inside(disc, {5, 0.9, 5}));
  CHECK_FALSE(is_inside(disc, {0, 1.1, 0}));
  Crossings none;
  find_crossings(Disc{{0, 0, 0}, {0, 0, 0}, 1, 0}, {{0, 1, 0}, {0, -1, 0}}, none);
  CHECK(none.empty());
}

TEST_CASE("Half-spaces along an axis have a box") {
  const Extent everywhere = Extent::everywhere();
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      for (const bool is_inverse : {false, true}) {
        CAPTURE(axis, sign, is_inverse);
        Plane plane;
        plane.normal = Vec3(0);
        plane.normal[axis] = 3 * sign;
        plane.distance = 0.5;
        const Extent extent = half_space(plane, Transform::translate({10, 20, 30}), is_inverse);
        Extent expected = everywhere;
        const double at = 10.0 * (axis + 1) + 0.5 * sign;
        ((sign > 0) != is_inverse ? expected.max : expected.min)[axis] = at;
        CHECK(extent.min == expected.min);
        CHECK(extent.max == expected.max);
      }
  CHECK(half_space({{1, 0.001, 0}, 1}, Transform(), false).is_everywhere());
}

TEST_CASE("Polygons have holes and no inside") {
  const auto square = [](double half) {
    return std::vector<Vec3>{{-half, 1, -half}, {half, 1, -half}, {half, 1, half}, {-half, 1, half}};
  };
  const Shape polygon = std::make_shared<const Polygon>(Polygon{{square(2), square(1)}});
  const auto crossings = [&](const Shape& shape, const Vec3& origin, const Vec3& direction) {
    Crossings found;
    find_crossings(shape, {origin, direction}, found);
    return found;
  };
  for (const Vec3& at : {Vec3(1.5, 3, 0.5), Vec3(-1.5, 3, 1.9), Vec3(0.5, 3, -1.5), Vec3(-1.1, 3, -1.1)}) {
    const Crossings found = crossings(polygon, at, {0, -2, 0});
    REQUIRE(found.size() == 1);
    CHECK(found[0].t == Approx(1));
    CHECK(std::abs(glm::normalize(found[0].normal).y) == Approx(1));
  }
  for (const Vec3& at : {Vec3(0.5, 3, 0.5), Vec3(2.1, 3, 0), Vec3(0, 3, -2.1), Vec3(-0.9, 3, 0.9)})
    CHECK(crossings(polygon, at, {0, -2, 0}).empty());
  CHECK(crossings(polygon, {-5, 1, 1.5}, {1, 0, 0}).empty());
  CHECK_FALSE(is_inside(polygon, {1.5, 1, 0}));
  const Extent extent = extent_of(polygon, Transform());
  CHECK(extent.min == Vec3(-2, 1 - 0.001, -2));
  CHECK(extent.max == Vec3(2, 1 + 0.001, 2));
  const Shape flat = std::make_shared<const Polygon>(Polygon{{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}});
  CHECK(crossings(flat, {0.5, 1, 0}, {0, -1, 0}).empty());
}

TEST_CASE("Boxes of shapes along the axes are tight") {
  const auto is_box = [](const Shape& shape, const Vec3& low, const Vec3& high) {
    const Extent extent = extent_of(shape, Transform());
    return glm::distance(extent.min, low) < 1e-12 && glm::distance(extent.max, high) < 1e-12;
  };
  CHECK(is_box(Cylinder{{1, 2, 3}, {1, 2, 5}, 0.5, false}, {0.5, 1.5, 3}, {1.5, 2.5, 5}));
  CHECK(is_box(Cylinder{{1, 2, 3}, {1, 5, 3}, 0.5, false}, {0.5, 2, 2.5}, {1.5, 5, 3.5}));
  CHECK(is_box(Cylinder{{1, 2, 3}, {4, 2, 3}, 0.5, false}, {1, 1.5, 2.5}, {4, 2.5, 3.5}));
  CHECK(is_box(Cylinder{{1, 2, 5}, {1, 2, 3}, 0.5, false}, {0.5, 1.5, 3}, {1.5, 2.5, 5}));
  CHECK(is_box(Cone{{0, 0, 0}, {0, 0, 2}, 1, 0.25, false}, {-1, -1, 0}, {1, 1, 2}));
  CHECK(is_box(Cone{{0, 0, 0}, {0, 0, 2}, 0.25, -1, false}, {-1, -1, 0}, {1, 1, 2}));
  CHECK(is_box(Disc{{1, 2, 3}, {0, 0, 2}, 0.5, 0.1}, {0.5, 1.5, 3 - 0.001}, {1.5, 2.5, 3 + 0.001}));
  CHECK(is_box(Disc{{1, 2, 3}, {0, 0, 0}, 0.5, 0.1}, {1, 2, 3}, {1, 2, 3}));
  CHECK(is_box(Torus{-2, 0.5}, {-2.5, -0.5, -2.5}, {2.5, 0.5, 2.5}));
  CHECK(is_box(Superellipsoid{1, 1}, Vec3(-1.0001), Vec3(1.0001)));
}

TEST_CASE("Spheres have a tight box unless they are sheared") {
  const Sphere ball{{1, 2, 3}, -2};
  const Transform turned = Transform::scale(Vec3(2)).then(Transform::rotate({10, 20, 30}));
  const Extent tight = extent_of(ball, turned);
  const Vec3 centre = turned.point(ball.centre);
  CHECK(glm::distance(tight.min, centre - Vec3(4)) < 1e-9);
  CHECK(glm::distance(tight.max, centre + Vec3(4)) < 1e-9);
  for (int row = 0; row < 3; ++row) {
    CAPTURE(row);
    Transform sheared;
    sheared.rows[row][(row + 1) % 3] = 0.5;
    const Extent box = Extent{Vec3(-1, 0, 1), Vec3(3, 4, 5)}.moved(sheared);
    const Extent extent = extent_of(ball, sheared);
    CHECK(glm::distance(extent.min, box.min) < 1e-12);
    CHECK(glm::distance(extent.max, box.max) < 1e-12);
  }
}

TEST_CASE("Quadrics have a box if they are ellipsoids along the axes") {
  Quadric ellipsoid;
  ellipsoid.square = {1, 4, 0.25};
  ellipsoid.linear = {-2, 0, 0};
  ellipsoid.constant = 0;
  const Extent extent = extent_of(ellipsoid, Transform());
  CHECK(glm::distance(extent.min, Vec3(0, -0.5, -2)) < 1e-12);
  CHECK(glm::distance(extent.max, Vec3(2, 0.5, 2)) < 1e-12);
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    for (const double square : {0.0, -1.0}) {
      Quadric open = ellipsoid;
      open.square[axis] = square;
      CHECK(extent_of(open, Transform()).is_everywhere());
    }
    Quadric askew = ellipsoid;
    askew.mixed[axis] = 0.1;
    CHECK(extent_of(askew, Transform()).is_everywhere());
  }
  Quadric nothing = ellipsoid;
  nothing.constant = 5;
  CHECK(extent_of(nothing, Transform()).volume() == 0);
}

TEST_CASE("Points and rays on faces and axes") {
  const Shape box = Box{{{-1, -1, -1}, {1, 1, 1}}};
  for (const double side : {-1.0, 1.0}) {
    CHECK(is_inside(box, {side, 0, 0}));
    CHECK(is_inside(box, {0, side, 0}));
    Crossings found;
    find_crossings(box, {{side, 0, -5}, {0, 0, 2}}, found);
    REQUIRE(found.size() == 2);
    CHECK(found[0].t == 2);
    CHECK(found[0].normal == Vec3(0, 0, -1));
    CHECK(found[1].t == 3);
    CHECK(found[1].normal == Vec3(0, 0, 1));
    found.clear();
    find_crossings(box, {{side * 1.0001, 0, -5}, {0, 0, 2}}, found);
    CHECK(found.empty());
  }
  const Shape cylinder = Cylinder{{0, 0, 0}, {0, 2, 0}, 1, false};
  for (const double height : {0.0, 2.0})
    CHECK(is_inside(cylinder, {0.5, height, 0}));
  CHECK_FALSE(is_inside(cylinder, {0.5, -1e-9, 0}));
  CHECK_FALSE(is_inside(cylinder, {0.5, 2 + 1e-9, 0}));
  const Shape rounded = Superellipsoid{0.5, 0.5};
  CHECK(is_inside(rounded, {0, 0, 0}));
  CHECK(is_inside(rounded, {0, 0, 0.99}));
  CHECK_FALSE(is_inside(rounded, {0, 0, 1.01}));
  Crossings along_axis;
  find_crossings(rounded, {{0, 0, -3}, {0, 0, 1}}, along_axis);
  CHECK(along_axis.size() == 2);
  Crossings in_ring; // through the middle of a torus
  find_crossings(Torus{1, 0.25}, {{0, -3, 0}, {0, 1, 0}}, in_ring);
  CHECK(in_ring.empty());
  Crossings around;
  find_crossings(Torus{1, 0.25}, {{-3, 0, 0}, {1, 0, 0}}, around);
  CHECK(around.size() == 4);
}
