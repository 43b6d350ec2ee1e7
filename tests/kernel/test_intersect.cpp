// Rays against single objects, in single precision by the kernel and in double precision by the reference.
//
// Tolerances are stated in units of what single precision can tell apart: kUnit times the numbers that went
// in, divided by how steeply the ray meets the surface. Within that distance of a silhouette or edge either
// answer is right; everywhere else the masks have to agree both ways.
#include "kernel/direct/pinhole_triangles.hpp"
#include "kernel/primitives/list.hpp"
#include "lanes.hpp"
#include "reference/geometry.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

constexpr double kUnit = 1.0 / (1 << 20); // sixteen times the rounding of a float
const int kPackets = times(8000);         // of sixteen rays, for each kind of object

struct Subject {
  ObjectRecord record;
  reference::Shape shape; ///< of exactly the numbers in the record
};

Subject sphere(const Vec3& centre, double radius) {
  Subject s{};
  s.record.kind_and_flags = static_cast<std::uint32_t>(ObjectKind::sphere);
  for (int i = 0; i < 3; ++i)
    s.record.geometry[i] = static_cast<float>(centre[i]);
  s.record.geometry[3] = static_cast<float>(radius);
  const float* g = s.record.geometry;
  s.shape.sphere = {{g[0], g[1], g[2]}, g[3]};
  return s;
}

Subject ellipsoid(const Transform& to_world) {
  Subject s{};
  s.record.kind_and_flags = static_cast<std::uint32_t>(ObjectKind::ellipsoid);
  const Transform inverse = to_world.inverse();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      float& value = s.record.geometry[row * 4 + column];
      value = static_cast<float>(inverse.rows[column][row]);
      s.shape.to_sphere.rows[column][row] = value;
    }
  s.shape.sphere = {{0, 0, 0}, 1};
  return s;
}

Subject triangle(const Vec3 (&corners)[3]) {
  Subject s{};
  s.record.kind_and_flags = static_cast<std::uint32_t>(ObjectKind::triangle);
  s.shape.triangle = true;
  for (int v = 0; v < 3; ++v)
    for (int i = 0; i < 3; ++i) {
      s.record.geometry[v * 3 + i] = static_cast<float>(corners[v][i]);
      s.shape.vertex[v][i] = s.record.geometry[v * 3 + i];
    }
  return s;
}

struct Lane {
  reference::Ray ray; ///< of exactly the numbers in the packet
  bool near_hit, far_hit;
  double near, far, u, v;
};

/// Calls `check(lane)` for sixteen rays of `next`.
template <class Next, class Check>
void for_each_ray(const Subject& subject, Next next, bool start_here, Check check) {
  RayPacket rays;
  for (unsigned l = 0; l < kSimdLanes; ++l) {
    const reference::Ray ray = next();
    set(rays.origin, l, ray.origin);
    set(rays.direction, l, ray.direction);
    rays.start_object.lane[l] = start_here ? 640 : kNoOffset;
  }
  const Crossings<Simd> c = intersect(rays, subject.record, 640);
  const FloatLanes near = lanes_of(c.near), far = lanes_of(c.far), u = lanes_of(c.u), v = lanes_of(c.v);
  for (unsigned l = 0; l < kSimdLanes; ++l)
    check(Lane{{at(rays.origin, l), at(rays.direction, l)},
               (c.near_hit.bits() >> l & 1) != 0,
               (c.far_hit.bits() >> l & 1) != 0,
               near.lane[l],
               far.lane[l],
               u.lane[l],
               v.lane[l]});
}

/// Rays of all kinds at something of size `size` around `target`.
reference::Ray any_ray(Random& random, const Vec3& target, double size) {
  const Vec3 aim = target + random.point(1.2 * size);
  const unsigned kind = random.below(5);
  if (kind == 0) return {target + random.point(0.4 * size), random.direction()}; // from inside
  if (kind == 1) {                                                               // along an axis
    Vec3 direction(0);
    direction[static_cast<int>(random.below(3))] = random.below(2) == 0 ? 1 : -1;
    return {aim - direction * random.uniform(0, 20 * size), direction};
  }
  const Vec3 direction = random.direction();
  const double distance =
      kind == 2 ? size * random.uniform(100, 1000) : size * random.uniform(0, 10); // 2: far away
  return {aim - direction * distance, direction};
}

/// Checks a lane against a closed surface. `scale`: the greatest number of the calculation over the object's
/// size, all in the space where it is a unit sphere; `stretch`: length there of a unit of the ray.
void check_closed(const Subject& subject, const Lane& lane, double scale) {
  const reference::Crossings expected = cross(subject.shape, lane.ray);
  const Vec3 o = (subject.shape.to_sphere.point(lane.ray.origin) - subject.shape.sphere.centre) /
                 subject.shape.sphere.radius;
  const Vec3 d = subject.shape.to_sphere.direction(lane.ray.direction) / subject.shape.sphere.radius;
  const double stretch = glm::length(d);
  const double square =
      1 - std::pow(glm::length(glm::cross(o, d)) / stretch, 2); // (half chord)^2 in that space
  const double fuzzy = kUnit * (scale + 1);
  if (std::abs(square) > fuzzy) {
    REQUIRE(lane.near_hit == (square > 0));
    REQUIRE(lane.far_hit == (square > 0));
  }
  if (!lane.near_hit || square < 10 * fuzzy) return;
  REQUIRE(expected.count == 2);
  const double tolerance = fuzzy / std::sqrt(square) / stretch;
  REQUIRE(std::abs(lane.near - expected.at[0].distance) <= tolerance);
  REQUIRE(std::abs(lane.far - expected.at[1].distance) <= tolerance);
}

} // namespace

TEST_CASE("Rays against spheres") {
  Random random(10);
  for (int k = 0; k < kPackets; ++k) {
    const double radius = std::pow(10.0, random.uniform(-2, 2));
    const Subject s = sphere(random.point(radius * 5), radius);
    for_each_ray(
        s, [&] { return any_ray(random, s.shape.sphere.centre, s.shape.sphere.radius); }, false,
        [&](const Lane& lane) {
          const double reach = glm::length(lane.ray.origin - s.shape.sphere.centre) / radius;
          check_closed(s, lane, reach + 10);
        });
  }
}

TEST_CASE("Rays against ellipsoids") {
  Random random(11);
  for (int k = 0; k < kPackets; ++k) {
    const Vec3 factors = {random.uniform(0.2, 2), random.uniform(0.2, 2), random.uniform(0.2, 2)};
    const Vec3 centre = random.point(5);
    const Subject s = ellipsoid(Transform::scale(factors)
                                    .then(Transform::rotate(random.point(180)))
                                    .then(Transform::translate(centre)));
    for_each_ray(
        s, [&] { return any_ray(random, centre, 1); }, false,
        [&](const Lane& lane) {
          const double reach = (glm::length(lane.ray.origin) + glm::length(centre)) * 5;
          check_closed(s, lane, reach + 10);
        });
  }
}

TEST_CASE("Rays that start on a sphere leave it at the other end") {
  Random random(12);
  for (int k = 0; k < kPackets; ++k) {
    const double radius = std::pow(10.0, random.uniform(-2, 2));
    const bool squeezed = k % 2 == 0;
    const Vec3 centre = random.point(radius * 3);
    const Transform to_world = Transform::scale(Vec3(radius) * (squeezed ? Vec3(1, 0.5, 0.7) : Vec3(1)))
                                   .then(Transform::translate(centre));
    const Subject s = squeezed ? ellipsoid(to_world) : sphere(centre, radius);
    const auto next = [&] { return reference::Ray{to_world.point(random.direction()), random.direction()}; };
    for_each_ray(s, next, true, [&](const Lane& lane) {
      REQUIRE_FALSE(lane.near_hit);
      const reference::Crossings expected = cross(s.shape, lane.ray);
      const double tolerance = 100 * kUnit * radius;
      const double leaves = expected.count == 2 ? expected.at[1].distance : 0;
      if (leaves > 0.1 * radius)
        REQUIRE((lane.far_hit && std::abs(lane.far - leaves) <= tolerance));
      else if (expected.count == 2 && expected.at[0].distance < -0.1 * radius) // goes away from it
        REQUIRE((!lane.far_hit || lane.far <= tolerance));
    });
  }
}

TEST_CASE("Rays against triangles") {
  Random random(13);
  for (int k = 0; k < kPackets; ++k) {
    const double size = std::pow(10.0, random.uniform(-2, 2));
    const Vec3 place = random.point(5 * size);
    const Subject s =
        triangle({place + random.point(size), place + random.point(size), place + random.point(size)});
    const Vec3* v = s.shape.vertex;
    const Vec3 area = glm::cross(v[1] - v[0], v[2] - v[0]);
    if (glm::length(area) < 1e-3 * size * size) continue;
    for_each_ray(
        s, [&] { return any_ray(random, place, size); }, false,
        [&](const Lane& lane) {
          REQUIRE_FALSE(lane.far_hit);
          // The reference's weights, unclipped, and how steeply the ray meets the plane.
          const Vec3 offset = lane.ray.origin - v[0];
          const double volume = -glm::dot(lane.ray.direction, area);
          const double reach = glm::length(offset) + glm::length(place) + size;
          if (std::abs(volume) < 1e-4 * size * size) return;
          const Vec3 moment = glm::cross(offset, lane.ray.direction);
          const double u = glm::dot(v[2] - v[0], moment) / volume;
          const double w = -glm::dot(v[1] - v[0], moment) / volume;
          const double t = glm::dot(offset, area) / volume;
          const double inside = std::min({u, w, 1 - u - w});
          const double fuzzy = kUnit * 8 * reach * size / std::abs(volume) * (1 + std::abs(u) + std::abs(w));
          if (std::abs(inside) > fuzzy + 2e-6) REQUIRE(lane.near_hit == (inside > 0));
          if (!lane.near_hit) return;
          REQUIRE(std::abs(lane.u - u) <= fuzzy);
          REQUIRE(std::abs(lane.v - w) <= fuzzy);
          REQUIRE(std::abs(lane.near - t) <= fuzzy * reach);
        });
    for_each_ray(
        s, [&] { return any_ray(random, place, size); }, true,
        [&](const Lane& lane) { REQUIRE_FALSE((lane.near_hit || lane.far_hit)); });
  }
}

TEST_CASE("Neighbouring triangles leave no gap") {
  // A fan around a point: rays at its edges and spokes hit one of the triangles or the next.
  Random random(14);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 centre = random.point(10);
    const Vec3 x = random.direction();
    const Vec3 y = glm::normalize(glm::cross(x, random.direction()));
    std::vector<Subject> fan;
    std::vector<Vec3> rim;
    for (int i = 0; i < 8; ++i)
      rim.push_back(centre + x * std::cos(0.785398 * i) + y * std::sin(0.785398 * i));
    for (int i = 0; i < 8; ++i)
      fan.push_back(triangle({centre, rim[i], rim[(i + 1) % 8]}));
    std::uint32_t hit = 0;
    RayPacket rays;
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const Vec3 aim = glm::mix(centre, rim[l % 8], l < 8 ? 0.0 : random.uniform(0, 0.9));
      const Vec3 direction = glm::normalize(glm::cross(x, y) * (l % 2 == 0 ? 1.0 : -1.0) + random.point(0.5));
      set(rays.origin, l, aim - direction * std::pow(10.0, random.uniform(0, 3)));
      set(rays.direction, l, glm::normalize(aim - at(rays.origin, l)));
      rays.start_object.lane[l] = kNoOffset;
    }
    for (const Subject& s : fan)
      hit |= intersect(rays, s.record, 64).near_hit.bits();
    REQUIRE(hit == 0xFFFF);
  }
}

TEST_CASE("Triangles seen from one point are crossed where a single triangle is, to the last bit") {
  Random random(15);
  int crossed = 0;
  for (int k = 0; k < times(4000); ++k) {
    const double size = std::pow(10.0, random.uniform(-3, 2));
    RayPacket rays{};
    const Vec3 eye = random.point(k % 3 == 0 ? 1000 * size : 3 * size);
    Subject subjects[kSimdLanes];
    ObjectRecord records[kSimdLanes];
    LeafTriangles<Simd> leaf(records);
    for (std::uint32_t i = 0; i < kSimdLanes; ++i) {
      const Vec3 corner = random.point(size), edge = random.point(size);
      // Some without area, some through the eye.
      const Vec3 last = i == 5 ? corner + edge * 2.0 : i == 6 ? eye : corner + random.point(size);
      subjects[i] = triangle({corner, corner + edge, last});
      records[i] = subjects[i].record;
      leaf.add(64 * i);
    }
    for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
      set(rays.origin, lane, eye);
      set(rays.direction, lane, glm::normalize(random.point(size) - eye));
      rays.start_object.lane[lane] = kNoOffset;
    }
    const float point[3] = {rays.origin.x.lane[0], rays.origin.y.lane[0], rays.origin.z.lane[0]};
    leaf.fill();
    const PinholeTriangles<Simd> seen(leaf.sides(), point);
    for (std::uint32_t i = 0; i < kSimdLanes; ++i) {
      const Crossings<Simd> one = intersect(rays, subjects[i].record, 64 * i);
      const Crossings<Simd> other = seen.crossed(i, rays.direction.load<Simd>());
      // Behind the point there are no hits.
      const M in_front = F(0.0f) < one.near;
      const std::uint32_t hit = (one.near_hit & in_front).bits();
      REQUIRE((other.near_hit & (F(0.0f) < other.near)).bits() == hit);
      REQUIRE(((other.near == one.near).bits() & hit) == hit);
      REQUIRE(((other.u == one.u).bits() & hit) == hit);
      REQUIRE(((other.v == one.v).bits() & hit) == hit);
      crossed += __builtin_popcount(hit);
    }
  }
  CHECK(crossed > times(20000));
}

TEST_CASE("Triangles occlude rays without a division where these cross them") {
  Random random(16);
  int crossed = 0, missed = 0;
  for (int k = 0; k < times(8000); ++k) {
    const double size = std::pow(10.0, random.uniform(-3, 2));
    const Vec3 corner = random.point(size);
    const Subject subject = triangle({corner, corner + random.point(size), corner + random.point(size)});
    RayPacket rays{};
    for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
      const Vec3 from = random.point(4 * size);
      set(rays.origin, lane, from);
      set(rays.direction, lane, glm::normalize(corner + random.point(size) - from));
      rays.start_object.lane[lane] = lane == 3 ? 64 : kNoOffset;
    }
    const auto first = static_cast<float>(random.uniform(0, 2 * size)),
               last = static_cast<float>(random.uniform(2 * size, 8 * size));
    const Crossings<Simd> c = intersect(rays, subject.record, 64);
    const TriangleTest<Simd> seen(rays.origin.load<Simd>(), TriangleSides<Simd>::of(subject.record));
    const std::uint32_t occluded =
        seen.crossed_between(rays.direction.load<Simd>(), lanes_that_start_on<Simd>(rays, 64), F(first),
                             F(last))
            .bits();
    const FloatLanes all_u = lanes_of(c.u), all_v = lanes_of(c.v), distance = lanes_of(c.near);
    for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
      const double u = all_u.lane[lane], v = all_v.lane[lane], at = distance.lane[lane];
      // Edges and ends are where rounding has them.
      const double margin = std::min({std::abs(u), std::abs(v), std::abs(1 - u - v)});
      if (margin < 2e-3 || std::abs(at - first) < 1e-3 * size || std::abs(at - last) < 1e-3 * size) continue;
      const bool crosses = (c.near_hit.bits() >> lane & 1) != 0 && at > first && at < last;
      REQUIRE((occluded >> lane & 1) == (crosses ? 1u : 0u));
      ++(crosses ? crossed : missed);
    }
  }
  CHECK(crossed > times(3000));
  CHECK(missed > times(8000));
}

TEST_CASE("Degenerate rays and triangles hit nothing and make no nonsense") {
  const Subject line = triangle({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  const Subject flat = triangle({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}});
  const auto check_miss = [](const Subject& s, const reference::Ray& ray) {
    for_each_ray(
        s, [&] { return ray; }, false,
        [](const Lane& lane) { CHECK_FALSE((lane.near_hit || lane.far_hit)); });
  };
  check_miss(line, {{0.5, 0.5, -1}, {0, 0, 1}});
  check_miss(flat, {{-3, 0, 0}, {1, 0, 0}});   // in its plane
  check_miss(flat, {{-3, 0, 0.5}, {1, 0, 0}}); // beside it
  check_miss(flat, {{0, 0, -1}, {0, 0, 0}});
  // A ray without a direction crosses a sphere nowhere that could be a hit.
  for_each_ray(
      sphere({0, 0, 0}, 1),
      [] {
        return reference::Ray{{0, 0, -3}, {0, 0, 0}};
      },
      false, [](const Lane& lane) { CHECK_FALSE((lane.near_hit || lane.far_hit)); });
}
