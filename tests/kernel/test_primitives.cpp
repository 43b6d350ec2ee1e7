// Every shape against what its inside says, in double precision: a ray crosses the surface where it changes
// from inside to outside. Shapes are placed at random, as a Scene places them.
#include "compiled_once.hpp"
#include "kernel/accel/object_bounds.hpp"
#include "kernel/primitives/shapes_module.hpp"
#include "lanes.hpp"
#include "prepared_scene.hpp"
#include "render/scenes.hpp"
#include "scene_image/shapes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// A shape in its own coordinates, by its inside.
struct Subject {
  std::string name;
  Object object;
  std::function<bool(const Vec3&)> inside;
  /// Without caps: crossings with them do not count.
  bool open = false;
};

double square(double x) {
  return x * x;
}

std::vector<Subject> subjects() {
  const auto named = [](const char* name, auto shape, std::function<bool(const Vec3&)> inside) {
    Object object;
    object.shape = shape;
    return Subject{name, object, std::move(inside)};
  };
  std::vector<Subject> all = {
      named("sphere", Sphere{{0.2, 0.1, -0.3}, 0.9},
            [](const Vec3& p) { return glm::length(p - Vec3(0.2, 0.1, -0.3)) < 0.9; }),
      named("plane", Plane{{1, 2, -1}, 0.3},
            [](const Vec3& p) { return glm::dot(p, glm::normalize(Vec3(1, 2, -1))) < 0.3; }),
      named("box", Box{{{1, -0.4, -0.7}, {-0.8, 0.9, 0.5}}},
            [](const Vec3& p) {
              return p.x > -0.8 && p.x < 1 && p.y > -0.4 && p.y < 0.9 && p.z > -0.7 && p.z < 0.5;
            }),
      named("cylinder", Cylinder{{0, -0.5, 0}, {0, 0.8, 0}, 0.6, false},
            [](const Vec3& p) { return p.y > -0.5 && p.y < 0.8 && std::hypot(p.x, p.z) < 0.6; }),
      named("cone", Cone{{0, -1, 0}, {0, 1, 0}, 0.9, 0, false},
            [](const Vec3& p) { return p.y > -1 && p.y < 1 && std::hypot(p.x, p.z) < 0.45 * (1 - p.y); }),
      named(
          "cut cone", Cone{{0, 0, -1}, {0, 0, 1}, 0.3, 0.8, false},
          [](const Vec3& p) { return p.z > -1 && p.z < 1 && std::hypot(p.x, p.y) < 0.3 + 0.25 * (p.z + 1); }),
      named(
          "cone like a cylinder", Cone{{0, -1, 0}, {0, 1, 0}, 0.6, 0.599998, false},
          [](const Vec3& p) { return p.y > -1 && p.y < 1 && std::hypot(p.x, p.z) < 0.6 - 1e-6 * (p.y + 1); }),
      named("torus", Torus{0.8, 0.25},
            [](const Vec3& p) { return square(std::hypot(p.x, p.z) - 0.8) + square(p.y) < square(0.25); }),
      named("thick torus", Torus{0.5, 0.45},
            [](const Vec3& p) { return square(std::hypot(p.x, p.z) - 0.5) + square(p.y) < square(0.45); }),
  };
  const auto superellipsoid = [&](const char* name, double e, double n) {
    all.push_back(named(name, Superellipsoid{e, n}, [e, n](const Vec3& p) {
      const Vec3 away = glm::abs(p);
      if (std::max({away.x, away.y, away.z}) > 1) return false; // powers take long
      const double across = std::pow(std::abs(p.x), 2 / e) + std::pow(std::abs(p.y), 2 / e);
      return std::pow(across, e / n) + std::pow(std::abs(p.z), 2 / n) < 1;
    }));
  };
  superellipsoid("superellipsoid", 0.5, 0.7);
  superellipsoid("box with round edges", 0.1, 0.25);
  superellipsoid("cylinder with round edges", 1, 0.1);
  superellipsoid("octahedron", 2, 2);
  superellipsoid("star", 2.5, 2.2);
  superellipsoid("pillar that is a star", 2.5, 0.5);
  superellipsoid("spindle", 0.5, 2.5);
  const auto quadric = [&](const char* name, const Quadric& q) {
    all.push_back(named(name, q, [q](const Vec3& p) {
      return glm::dot(q.square, p * p) + glm::dot(q.mixed, Vec3(p.x * p.y, p.x * p.z, p.y * p.z)) +
                 glm::dot(q.linear, p) + q.constant <
             0;
    }));
  };
  quadric("ellipsoid", {{2, 3, 1.5}, {0.4, -0.3, 0.2}, {0.1, 0.2, -0.3}, -0.9});
  quadric("space around an ellipsoid", {{-2, -3, -1.5}, {0.4, 0, 0.2}, {0, 0, 0}, 0.9});
  quadric("hyperboloid", {{1, -1, 1}, {0, 0, 0}, {0, 0, 0}, -0.2});
  quadric("hyperboloid of two sheets", {{1, -2, 1}, {0.5, 0, 0}, {0, 0.3, 0}, 0.1});
  quadric("double cone", {{1, -1, 1}, {0, 0, 0}, {0, 0, 0}, 0});
  quadric("paraboloid", {{1, 0, 2}, {0, 0, 0}, {0.2, -1, 0}, -0.1});
  quadric("saddle", {{1, -1, 0}, {0.3, 0, 0}, {0, 0, 1}, 0.1});
  quadric("elliptic cylinder", {{1, 0, 3}, {0, 1, 0}, {0.1, 0, 0}, -0.3});
  quadric("parabolic cylinder", {{1, 0, 0}, {0, 0, 0}, {0, 0.3, -1}, 0.1});
  quadric("pair of planes", {{0, 1, 0}, {0, 0, 0}, {0, 0, 0}, -0.2});
  quadric("plane by linear terms", {{0, 0, 0}, {0, 0, 0}, {1, 2, -1}, -0.3});
  return all;
}

struct Found {
  double distance;
  bool expected;
};

ObjectRecord record_of(const PlacedShape& shape, ExtraRecord& extra) {
  ObjectRecord record{};
  record.kind_and_flags = shape.kind_and_flags;
  std::copy(shape.geometry, shape.geometry + 12, record.geometry);
  extra = {};
  std::copy(shape.parameters, shape.parameters + 2, extra.value);
  return record;
}

std::uint32_t subject_kind(const Subject& subject) {
  return place_shape(subject.object).kind_and_flags & object_flag::kind_mask;
}

Transform random_transform(Random& random) {
  return Transform::scale({random.uniform(0.3, 3), random.uniform(0.3, 3), random.uniform(0.3, 3)})
      .then(Transform::rotate(random.point(180)))
      .then(Transform::translate(random.point(5)));
}

/// The distances at which a ray changes sides, or the first `most` of them.
std::vector<double> changes(const std::function<bool(double)>& inside, double from, double to,
                            std::size_t most = SIZE_MAX) {
  constexpr int kSteps = 4000;
  std::vector<double> all;
  bool before = inside(from);
  for (int i = 1; i <= kSteps && all.size() < most; ++i) {
    const double t = from + (to - from) * i / kSteps;
    const bool now = inside(t);
    if (now == before) continue;
    double low = t - (to - from) / kSteps, high = t;
    for (int halving = 0; halving < 50; ++halving) {
      const double middle = 0.5 * (low + high);
      (inside(middle) == before ? low : high) = middle;
    }
    all.push_back(low);
    before = now;
  }
  return all;
}

std::vector<double> crossings_of(const Crossings<Simd>* crossings, std::uint32_t pairs, unsigned lane) {
  std::vector<double> all;
  for (std::uint32_t pair = 0; pair < pairs; ++pair) {
    const FloatLanes near = lanes_of(crossings[pair].near), far = lanes_of(crossings[pair].far);
    if ((crossings[pair].near_hit.bits() >> lane & 1) != 0) all.push_back(near.lane[lane]);
    if ((crossings[pair].far_hit.bits() >> lane & 1) != 0) all.push_back(far.lane[lane]);
  }
  std::sort(all.begin(), all.end());
  return all;
}

} // namespace

TEST_CASE("Rays cross every shape where they change sides") {
  Random random(11);
  for (const Subject& subject : subjects()) {
    int compared = 0, crossed = 0, off = 0;
    for (int round = 0; round < times(160); ++round) {
      Object object = subject.object;
      object.transform = round == 0 ? Transform() : random_transform(random);
      const Transform inverse = object.transform.inverse();
      ExtraRecord extra;
      const ObjectRecord record = record_of(place_shape(object), extra);
      RayPacket rays;
      for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
        const Vec3 target = object.transform.point(random.point(0.9));
        const Vec3 direction = random.direction();
        set(rays.origin, lane, target - direction * random.uniform(0, 8));
        set(rays.direction, lane, direction);
        rays.start_object.lane[lane] = kNoOffset;
      }
      Crossings<Simd> crossings[kMaxCrossingPairs];
      std::uint32_t pairs = 0;
      Primitives::dispatch(record.kind_and_flags & object_flag::kind_mask, [&](auto shape) {
        using Shape = decltype(shape);
        pairs = Shape::kCrossingPairs;
        Shape::template intersect<Simd>(rays, record, extra, 640, crossings);
      });
      for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
        const Vec3 origin = at(rays.origin, lane), direction = at(rays.direction, lane);
        const auto inside = [&](double t) { return subject.inside(inverse.point(origin + direction * t)); };
        constexpr double kReach = 40;
        const std::vector<double> expected = changes(inside, -kReach, kReach);
        std::vector<double> found = crossings_of(crossings, pairs, lane);
        found.erase(std::remove_if(found.begin(), found.end(),
                                   [&](double t) { return std::abs(t) > kReach * 0.999; }),
                    found.end());
        // Grazing rays may or may not cross: of those that do not agree, few are left.
        if (found.size() != expected.size()) continue;
        ++compared;
        for (std::size_t i = 0; i < found.size(); ++i) {
          // By how far the surface is from the point, not along the ray, which may graze it.
          const bool changes_here = inside(found[i] - 2e-3) != inside(found[i] + 2e-3);
          off += !changes_here && std::abs(found[i] - expected[i]) > 2e-2;
          ++crossed;
        }
      }
    }
    INFO(subject.name);
    CHECK(off <= 1 + crossed / 500);
    CHECK(compared > 0.985 * times(160) * int{kSimdLanes});
    CHECK(crossed > times(160) * int{kSimdLanes} / 2);
  }
}

namespace {

/// Rays from all sides through points within `reach` of the origin, transformed, or from there.
RayPacket rays_to(const Transform& transform, double reach, Random& random) {
  RayPacket rays;
  for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
    const Vec3 direction = random.direction();
    set(rays.origin, lane, transform.point(random.point(reach)) - direction * random.uniform(0, 4));
    set(rays.direction, lane, direction);
    rays.start_object.lane[lane] = kNoOffset;
  }
  return rays;
}

} // namespace

TEST_CASE("Of crossings of which some will do there are those") {
  Random random(21);
  for (const Subject& subject : subjects()) {
    if (!is_local(subject_kind(subject))) continue;
    INFO(subject.name);
    for (int round = 0; round < times(40); ++round) {
      Object object = subject.object;
      object.transform = random_transform(random);
      ExtraRecord extra;
      const ObjectRecord record = record_of(place_shape(object), extra);
      const RayPacket rays = rays_to(object.transform, 0.9, random);
      const auto limit = static_cast<float>(random.uniform(0, 4));
      const auto cross = [&](float enough, float farthest) {
        std::vector<std::vector<double>> all(kSimdLanes);
        Crossings<Simd> crossings[kMaxCrossingPairs] = {};
        Primitives::dispatch(record.kind_and_flags & object_flag::kind_mask, [&](auto shape) {
          using Shape = decltype(shape);
          if constexpr (Shape::kIsLocal) {
            FloatLanes limits;
            Simd::F(farthest).store(limits.lane);
            Shape::template intersect_local<Simd>(local_rays<Simd>(rays, record, 640, 0, {enough, &limits}),
                                                  local_parameters<Simd>(record, extra), crossings);
            for (unsigned lane = 0; lane < kSimdLanes; ++lane)
              all[lane] = crossings_of(crossings, Shape::kCrossingPairs, lane);
          }
        });
        return all;
      };
      const auto all = cross(kEveryCrossing, kEveryCrossing), some = cross(kMinHitDistance, kEveryCrossing),
                 near = cross(kEveryCrossing, limit);
      const bool is_torus = subject_kind(subject) == kPrimitiveKind<TorusPrimitive>;
      std::uint32_t any = 0; // rays that cross it, without their crossings
      if (is_torus) {
        FloatLanes limits;
        Simd::F(limit).store(limits.lane);
        const CrossingRequest request = {kShadowEpsilon, &limits};
        const LocalRays<Simd> in_time = local_rays<Simd>(rays, record, 640, 0, request);
        const Simd::F ratio(extra.value[0]);
        any = TorusPrimitive::crossed<Simd>(TorusPrimitive::may_hit<Simd>(in_time, ratio), in_time, ratio,
                                            nullptr)
                  .bits();
        REQUIRE((TorusPrimitive::surely_crossed<Simd>(in_time, ratio, nullptr).bits() & ~any) == 0);
      }
      for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
        const auto in_front = [](const std::vector<double>& crossings) {
          const auto first =
              std::find_if(crossings.begin(), crossings.end(), [](double t) { return t > kMinHitDistance; });
          return first == crossings.end() ? -1 : *first;
        };
        REQUIRE(in_front(some[lane]) == in_front(all[lane]));
        for (const double crossing : all[lane])
          if (crossing <= limit) {
            const std::vector<double>& found = near[lane];
            REQUIRE(std::find(found.begin(), found.end(), crossing) != found.end());
          }
        // Unless one is where what is asked for begins or ends.
        const auto is_asked = [&](double t) { return t > kShadowEpsilon && t < limit - kShadowEpsilon; };
        const auto is_at_an_end = [&](double t) {
          return std::abs(t - kShadowEpsilon) < 1e-4 || std::abs(t - (limit - kShadowEpsilon)) < 1e-4;
        };
        if (is_torus && std::none_of(all[lane].begin(), all[lane].end(), is_at_an_end))
          REQUIRE((any >> lane & 1) == std::any_of(all[lane].begin(), all[lane].end(), is_asked));
      }
    }
  }
}

namespace {

Object a_torus(Random& random) {
  Object torus;
  torus.shape = Torus{random.uniform(0.5, 1), random.uniform(0.02, 0.6)};
  torus.transform = random_transform(random);
  return torus;
}
/// A scene with a torus that a box or a plane clips, in one of three ways.
Scene with_clipped(Object torus, Random& random) {
  Object other;
  const Vec3 corner = random.point(1);
  other.shape = Box{corner, corner + glm::abs(random.point(2)) + Vec3(0.1, 0.1, 0.1)};
  other.transform = torus.transform;
  if (random.below(3) == 0) other.shape = Plane{random.direction(), random.uniform(-0.5, 0.5)};
  Scene scene;
  scene.add(matte({1, 1, 1}));
  scene.add(Interior{});
  const int kind = static_cast<int>(random.below(3));
  if (kind == 2) {
    torus.clipped_by = std::make_shared<const std::vector<Object>>(std::vector<Object>{other});
    scene.objects = {torus};
  } else {
    Object csg;
    csg.shape = std::make_shared<const Csg>(
        Csg{kind == 0 ? Csg::Operation::difference : Csg::Operation::intersection, {torus, other}});
    scene.objects = {csg};
  }
  return scene;
}

} // namespace

TEST_CASE("Tori that a box or a plane clips occlude rays where these cross them on the side that is kept") {
  Random random(160);
  int occluded = 0, clipped = 0, off = 0, compared = 0;
  for (int round = 0; round < times(300); ++round) {
    const Object torus = a_torus(random);
    const Scene scene = with_clipped(torus, random);
    const PreparedScene prepared(scene);
    DirectSpu spu;
    SceneAccess<DirectSpu> access(spu, CacheConfig::off(), prepared.frame().image);
    const auto tests = std::make_unique<ObjectTests<DirectSpu>>(access);
    const RayPacket rays = rays_to(torus.transform, 1.2, random);
    FloatLanes distance;
    for (float& lane : distance.lane)
      lane = static_cast<float>(random.uniform(0.5, 6));
    for (std::uint32_t i = 0; i < prepared.object_count(); ++i) {
      const ObjectRecord& object = prepared.object(i);
      if ((object.kind_and_flags & object_flag::kind_mask) != kPrimitiveKind<TorusPrimitive>) continue;
      REQUIRE((object.kind_and_flags & object_flag::csg) != 0);
      const std::uint32_t condition = prepared.record<ExtraRecord>(object.extra).csg;
      REQUIRE(condition != kNoOffset);
      REQUIRE(ClippingObject::of(access, condition).object != nullptr);
      HitPacket hits;
      Simd::F(kMaxHitDistance).store(hits.distance.lane);
      VectorLanes light;
      tests->hit_filter().begin_packet();
      tests->test_closest(rays, prepared.object_offset(i), hits);
      tests->hit_filter().begin_packet();
      const std::uint32_t dark = tests->occluded(rays, prepared.object_offset(i), 0xFFFF, distance, light);
      Crossings<Simd> all[kMaxCrossingPairs];
      TorusPrimitive::intersect_local<Simd>(
          local_rays<Simd>(rays, object, kNoOffset - 64),
          local_parameters<Simd>(object, prepared.record<ExtraRecord>(object.extra)), all);
      for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
        // Unless it is where what is asked for begins or ends.
        const double hit = hits.distance.lane[lane], last = distance.lane[lane] - kShadowEpsilon;
        if (std::abs(hit - kShadowEpsilon) < 1e-3 || std::abs(hit - last) < 1e-3) continue;
        const bool is_dark = (dark >> lane & 1) != 0;
        off += is_dark != (hit > kShadowEpsilon && hit < last);
        occluded += is_dark;
        bool crosses = false;
        for (const double at : crossings_of(all, TorusPrimitive::kCrossingPairs, lane))
          crosses |= at > kShadowEpsilon && at < last;
        clipped += crosses && !is_dark;
        ++compared;
      }
    }
  }
  // Where a ray crosses the torus at a face of what clips it, rounding decides.
  CHECK(off <= compared / 2000);
  CHECK(occluded > times(300));
  CHECK(clipped > times(100));
}

namespace {

/// Rays to one of a scene's objects, some of which start on an object, and some in the plane of the top of
/// the box from -1 to 1 and along it.
RayPacket rays_in(const Scene& scene, std::uint32_t start, Random& random) {
  RayPacket rays = rays_to(scene.objects[random.below(scene.objects.size())].transform, 1.2, random);
  const bool some_start = random.below(2) == 0;
  for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
    rays.start_object.lane[lane] = some_start && random.below(8) == 0 ? start : 0;
    if (random.below(8) != 0) continue;
    rays.origin.y.lane[lane] = 1;
    rays.direction.y.lane[lane] = 0;
  }
  return rays;
}

} // namespace

TEST_CASE("Several packets against an object have the hits and shadows of each of them by itself") {
  constexpr std::uint32_t kPackets = 16;
  Random random(163);
  int hits = 0, occluded = 0, off = 0;
  for (int round = 0; round < times(100); ++round) {
    Scene scene = with_clipped(a_torus(random), random);
    scene.objects.push_back(a_torus(random));
    Object box;
    box.shape = Box{Vec3(-1), Vec3(1)};
    scene.objects.push_back(box);
    for (const Subject& subject : subjects()) {
      scene.objects.push_back(subject.object);
      scene.objects.back().transform = random_transform(random);
    }
    const PreparedScene prepared(scene);
    DirectSpu spu;
    SceneAccess<DirectSpu> access(spu, CacheConfig::off(), prepared.frame().image);
    const auto tests = std::make_unique<ObjectTests<DirectSpu>>(access);
    for (std::uint32_t i = 0; i < prepared.object_count(); ++i) {
      const std::uint32_t self = prepared.object_offset(i);
      const ObjectRecord& object = prepared.object(i);
      const std::uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
      const bool is_plain = (object.kind_and_flags & object_flag::csg) == 0 && !Primitives::is_heavy(kind) &&
                            kind != kPrimitiveKind<PlanePrimitive>;
      ExtraRecord extra = {};
      if (object.extra != kNoOffset) extra = prepared.record<ExtraRecord>(object.extra);
      RayPacket rays[kPackets];
      FloatLanes distance[kPackets];
      VectorLanes light;
      HitPacket found[kPackets], expected[kPackets];
      RayQuery closest[kPackets], all[kPackets], some[kPackets];
      std::uint32_t lanes[kPackets], packets = 0, dark[kPackets];
      for (std::uint32_t k = 0; k < kPackets; ++k) {
        rays[k] = rays_in(scene, self, random);
        for (float& far : distance[k].lane)
          far = static_cast<float>(random.uniform(0.5, 6));
        lanes[k] = random.word() & 0xFFFF;
        packets |= (random.below(4) != 0 && lanes[k] != 0 ? 1u : 0u) << k;
        expected[k] = {};
        expected[k].distance = distance[k];
        found[k] = expected[k];
        closest[k] = {&rays[k], &found[k], nullptr, nullptr, 0xFFFF};
        all[k] = some[k] = {&rays[k], nullptr, &distance[k], &light, 0xFFFF};
        if (is_plain) {
          Crossings<Simd> c[kMaxCrossingPairs];
          module_shapes::intersect(spu, rays[k], object, extra, self, c);
          keep_closest<Simd>(c[0], self, expected[k]);
          const auto shadow = ObjectTests<DirectSpu>::shadow_hits(c[0], distance[k]);
          dark[k] = shadow.near | shadow.far;
        } else {
          tests->test_closest(rays[k], self, expected[k]);
          tests->hit_filter().begin_packet();
          dark[k] = tests->occluded(rays[k], self, 0xFFFF, distance[k], light);
        }
      }
      if (packets == 0) continue;
      tests->test_closest_of_all(closest, packets, self);
      tests->test_occlusion_of_all(all, packets, self);
      tests->test_occlusion_of_some(some, packets, lanes, self);
      for (std::uint32_t k = 0; k < kPackets; ++k) {
        const bool asked = (packets >> k & 1) != 0;
        for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
          const bool is_hit = asked && expected[k].object.lane[lane] == self;
          REQUIRE((found[k].object.lane[lane] == self) == is_hit);
          REQUIRE(found[k].distance.lane[lane] == (asked ? expected : found)[k].distance.lane[lane]);
          hits += is_hit;
        }
        REQUIRE((~all[k].lanes & 0xFFFF) == (asked ? dark[k] : 0));
        const std::uint32_t lost = asked ? dark[k] & lanes[k] : 0;
        off += __builtin_popcount((~some[k].lanes & 0xFFFF) ^ lost);
        occluded += __builtin_popcount(lost);
      }
    }
  }
  // Of tori, rounding may decide otherwise near their surface.
  CHECK(off <= occluded / 10000);
  CHECK(occluded > times(5000));
  CHECK(hits > times(5000));
}

TEST_CASE("Rays that start on a shape do not cross it there") {
  Random random(12);
  for (const Subject& subject : subjects()) {
    int wrong = 0, all = 0;
    for (int round = 0; round < times(80); ++round) {
      Object object = subject.object;
      object.transform = random_transform(random);
      ExtraRecord extra;
      const ObjectRecord record = record_of(place_shape(object), extra);
      const Transform inverse = object.transform.inverse();
      RayPacket rays;
      std::vector<double> expected[kSimdLanes];
      for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
        // A point of the surface, found along a ray.
        for (;;) {
          const Vec3 from = object.transform.point(random.point(1.2)), along = random.direction();
          const auto here =
              changes([&](double t) { return subject.inside(inverse.point(from + along * t)); }, 0, 10, 1);
          if (here.empty()) continue;
          set(rays.origin, lane, from + along * here[0]);
          break;
        }
        const Vec3 direction = random.direction();
        set(rays.direction, lane, direction);
        rays.start_object.lane[lane] = 640;
        const Vec3 origin = at(rays.origin, lane);
        expected[lane] = changes(
            [&](double t) { return subject.inside(inverse.point(origin + direction * t)); }, 5e-3, 40);
      }
      Crossings<Simd> crossings[kMaxCrossingPairs];
      std::uint32_t pairs = 0;
      Primitives::dispatch(record.kind_and_flags & object_flag::kind_mask, [&](auto shape) {
        using Shape = decltype(shape);
        pairs = Shape::kCrossingPairs;
        Shape::template intersect<Simd>(rays, record, extra, 640, crossings);
      });
      for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
        std::vector<double> found = crossings_of(crossings, pairs, lane);
        found.erase(std::remove_if(found.begin(), found.end(), [](double t) { return t < 1e-4 || t > 40; }),
                    found.end());
        ++all;
        wrong += found.size() != expected[lane].size();
      }
    }
    INFO(subject.name << ": " << wrong << " of " << all);
    CHECK(wrong < 0.02 * all);
  }
}

TEST_CASE("Bounds hold what is inside") {
  Random random(13);
  for (const Subject& subject : subjects()) {
    if (subject.name == "plane") continue;
    INFO(subject.name);
    for (int round = 0; round < times(200); ++round) {
      Object object = subject.object;
      object.transform = random_transform(random);
      const Aabb box = place_shape(object).bounds();
      for (int i = 0; i < 200; ++i) {
        const Vec3 own = random.point(1.2);
        if (!subject.inside(own)) continue;
        const Vec3 p = object.transform.point(own);
        for (int axis = 0; axis < 3; ++axis) {
          REQUIRE(p[axis] >= box.min[axis] - 1e-4);
          REQUIRE(p[axis] <= box.max[axis] + 1e-4);
        }
      }
    }
  }
}
