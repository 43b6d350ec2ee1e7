// Bundles of rays to a light: what they are bounded by, which triangles their packets see, and what light
// comes to them.
#include "compiled_once.hpp"
#include "kernel/direct/light_bundle.hpp"
#include "kernel/direct/shadow_volumes.hpp"
#include "kernel/direct/triangle_culling.hpp"
#include "made_records.hpp"
#include "prepared_scene.hpp"
#include "soups.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

constexpr std::uint32_t kPackets = 16;

/// Packets that look at a light from a patch of a rough surface, some far behind it.
struct ShadowBundle {
  RayPacket rays[kPackets];
  FloatLanes distance[kPackets];
  VectorLanes light[kPackets];
  RayQuery queries[kPackets];
  float place[3]; ///< of the light

  ShadowBundle(Random& random, const Vec3& middle, double size, const Vec3& light_place) {
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = static_cast<float>(light_place[axis]);
    const Vec3 normal = random.direction();
    const Vec3 right = glm::normalize(glm::cross(normal, random.direction()));
    const Vec3 down = glm::cross(right, normal);
    const double rough = random.below(2) == 0 ? 0 : std::pow(10.0, random.uniform(-3, 0));
    const Vec3 behind = random.below(4) == 0 ? random.point(20 * size) : Vec3(0);
    for (std::uint32_t i = 0; i < kPackets; ++i) {
      for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
        const double x = (i % 4) * 4 + lane % 4, y = (i / 4) * 4 + lane / 4;
        const Vec3 point = middle + (right * x + down * y) * (size / 16) + random.point(rough * size) +
                           (x + y > 20 ? behind : Vec3(0));
        start_at(point, i, lane);
        rays[i].start_object.lane[lane] = kNoOffset;
      }
      light[i] = lanes_of(Vec{F(1.0f), F(0.5f), F(2.0f)});
      const std::uint32_t lanes = random.below(3) == 0 ? (random.word() & 0xFFFF) | 1 : 0xFFFF;
      queries[i] = {&rays[i], nullptr, &distance[i], &light[i], lanes};
    }
  }

  /// Lets one of the rays start at `point`.
  void start_at(const Vec3& point, std::uint32_t packet, unsigned lane) {
    set(rays[packet].origin, lane, point);
    const Vec3 to_light = Vec3(place[0], place[1], place[2]) - at(rays[packet].origin, lane);
    set(rays[packet].direction, lane, glm::normalize(to_light));
    distance[packet].lane[lane] = static_cast<float>(glm::length(to_light));
  }
};

/// Lets all rays start in the plane z = 0, 0.1 apart from (0, 0) on.
void start_on_grid(ShadowBundle& bundle) {
  for (std::uint32_t i = 0; i < kPackets; ++i) {
    for (unsigned lane = 0; lane < kSimdLanes; ++lane)
      bundle.start_at({0.1 * ((i % 4) * 4 + lane % 4), 0.1 * ((i / 4) * 4 + lane / 4), 0}, i, lane);
    bundle.queries[i].lanes = 0xFFFF;
  }
}

/// From next to the bundle to farther away than any sun.
Vec3 any_light(Random& random, const Vec3& middle, double size) {
  return middle + random.direction() * (size * std::pow(10.0, random.uniform(0.2, 6)));
}

std::uint32_t between(const F& at, const FloatLanes& distance) {
  const F low(1e-3f);
  return ((at > low) & (at < load(distance) - low)).bits();
}

/// Calls `visit(traversal, light, one, other)` with two random bundles that are alike, and their light.
template <class Visit> void with_two_bundles(Random& random, const FrameBlock& frame, const Visit& visit) {
  const Vec3 middle = random.point(12);
  const double size = std::pow(10.0, random.uniform(-1, 0.7));
  const Vec3 lamp = any_light(random, middle, size);
  const Random state = random;
  ShadowBundle one(random, middle, size, lamp);
  random = state;
  ShadowBundle other(random, middle, size, lamp);
  DirectSpu spu;
  SceneAccess<DirectSpu> access(spu, CacheConfig(), frame.image);
  Traversal<DirectSpu> traversal(access, frame);
  LightRecord light{};
  std::copy(one.place, one.place + 3, light.location);
  visit(traversal, light, one, other);
}
using ShadowTraversal = Traversal<DirectSpu>;

} // namespace

TEST_CASE("The beams of rays to a light meet every box that one of them meets before it") {
  Random random(120);
  int near = 0, far = 0;
  for (int k = 0; k < times(4000); ++k) {
    const double size = std::pow(10.0, random.uniform(-2, 2));
    const Vec3 middle = random.point(k % 3 == 0 ? 100 * size : size);
    const ShadowBundle shadows(random, middle, size, any_light(random, middle, size));
    const LightBundle<Simd> bundle(shadows.place, shadows.queries, kPackets);
    if (bundle.packets == 0) continue;
    ++(bundle.turned ? near : far);
    BundleFrusta<Simd, kPackets> beams;
    beams.set(bundle.bounds, bundle.octant);
    Frustum<Simd> around;
    around.set(bundle.all, bundle.octant);
    const SlabOrder sides(bundle.octant);
    alignas(64) float limits[kPackets];
    (bundle.reach * F(1.00001f)).store(limits);
    float farthest = 0;
    for_each_lane(bundle.packets, [&](std::uint32_t i) { farthest = std::max(farthest, limits[i]); });
    for (int trial = 0; trial < 40; ++trial) {
      const std::uint32_t packet = random.below(kPackets), lane = random.below(kSimdLanes);
      if ((bundle.packets >> packet & 1) == 0 || (shadows.queries[packet].lanes >> lane & 1) == 0) continue;
      const RayPacket& rays = shadows.rays[packet];
      const double along = shadows.distance[packet].lane[lane] * std::pow(10.0, random.uniform(-6, 0));
      const Vec3 point = at(rays.origin, lane) + at(rays.direction, lane) * along;
      // Not less than the coordinates' own rounding.
      const double half = (3e-6 + std::pow(10.0, random.uniform(-5, 0))) *
                          (glm::length(glm::abs(point)) + glm::length(glm::abs(at(rays.origin, lane))));
      const Vec3 centre = point + random.point(0.9 * half);
      alignas(16) float box[6][4];
      put_box(box, centre - half, centre + half);
      const std::uint32_t child = random.below(4);
      INFO((bundle.turned ? "from the light" : "from afar") << ", packet " << packet << ", " << along);
      REQUIRE((beams.intersect(box, sides, child, limits) >> packet & 1) == 1);
      alignas(16) float enter[4];
      REQUIRE(around.intersect(box, sides, farthest, enter) == 0xF);
      REQUIRE(enter[child] <= limits[packet]);
    }
  }
  CHECK(near > times(300));
  CHECK(far > times(300));
}

TEST_CASE("Packets see the triangles that their rays to a light cross, and cross them where they do") {
  Random random(121);
  int crossed = 0, unseen = 0;
  for (int k = 0; k < times(4000); ++k) {
    const double size = std::pow(10.0, random.uniform(-1, 2));
    const Vec3 middle = random.point(k % 3 == 0 ? 100 * size : size);
    const ShadowBundle shadows(random, middle, size, any_light(random, middle, size));
    const LightBundle<Simd> bundle(shadows.place, shadows.queries, kPackets);
    if (bundle.packets == 0) continue;
    // Triangles around points of rays, not farther away than the surface is large, or the light.
    const unsigned count = 1 + random.below(LeafTriangles<Simd>::kMost);
    ObjectRecord records[LeafTriangles<Simd>::kMost];
    LeafTriangles<Simd> leaf(records);
    for (unsigned i = 0; i < count; ++i) {
      const std::uint32_t packet = random.below(kPackets), lane = random.below(kSimdLanes);
      const RayPacket& rays = shadows.rays[packet];
      const double most = std::min<double>(shadows.distance[packet].lane[lane], 30 * size);
      const Vec3 point = at(rays.origin, lane) + at(rays.direction, lane) * (most * random.uniform(0, 1.1));
      const double side = size * std::pow(10.0, random.uniform(-2, 1));
      records[i] =
          triangle(point + random.point(side), point + random.point(side), point + random.point(side));
      leaf.add(64 * i);
    }
    leaf.fill();
    const TriangleCulling<Simd> viewed(leaf.sides(), bundle.view);
    const ShadowVolumes<Simd> volumes(leaf.sides(), *bundle.view.shadows);
    for (unsigned i = 0; i < count; ++i) {
      const std::uint32_t seen_by = viewed.seen_by(i, bundle.view);
      for_each_lane(bundle.packets, [&](std::uint32_t packet) {
        const RayPacket& rays = shadows.rays[packet];
        const Crossings<Simd> c = intersect(rays, records[i], 64 * i);
        const std::uint32_t lanes = shadows.queries[packet].lanes;
        const std::uint32_t hits = c.near_hit.bits() & between(c.near, shadows.distance[packet]) & lanes;
        INFO("triangle " << i << ", packet " << packet
                         << (bundle.turned ? ", from the light" : ", from afar"));
        if (hits != 0) REQUIRE((seen_by >> packet & 1) == 1);
        unseen += (seen_by >> packet & 1) == 0;
        const std::uint32_t by = volumes.crossed(i, *bundle.view.shadows, packet).bits() & lanes;
        // But where rounding decides: at sides and ends, and along the plane.
        const FloatLanes u = lanes_of(c.u), v = lanes_of(c.v), near = lanes_of(c.near);
        for_each_lane(hits ^ by, [&](std::uint32_t lane) {
          const Vec3 a(records[i].geometry[0], records[i].geometry[1], records[i].geometry[2]);
          const Vec3 edge1 = Vec3(records[i].geometry[3], records[i].geometry[4], records[i].geometry[5]) - a;
          const Vec3 edge2 = Vec3(records[i].geometry[6], records[i].geometry[7], records[i].geometry[8]) - a;
          const Vec3 d = at(rays.direction, lane);
          const double cosine =
              std::abs(glm::dot(glm::cross(edge1, edge2), d)) / (glm::length(edge1) * glm::length(edge2));
          const double least = std::min(
              {std::abs(u.lane[lane]), std::abs(v.lane[lane]), std::abs(1 - u.lane[lane] - v.lane[lane])});
          const double reach = glm::length(at(rays.origin, lane) - a) + 1e-7 * glm::length(a);
          const double doubt = 1e-5 * reach / (std::min(glm::length(edge1), glm::length(edge2)) * cosine);
          const double end = std::min(std::abs(near.lane[lane] - 1e-3),
                                      std::abs(near.lane[lane] - shadows.distance[packet].lane[lane] + 1e-3));
          CAPTURE(lane, cosine, least, doubt, end, near.lane[lane], shadows.distance[packet].lane[lane]);
          REQUIRE((least < doubt || end < 1e-6 * (near.lane[lane] + reach) / cosine));
        });
        crossed += __builtin_popcount(hits);
      });
    }
  }
  CHECK(crossed > times(10000));
  CHECK(unseen > times(10000));
}

TEST_CASE("Packets beside a sharp corner of a triangle do not see it") {
  // The corner lies above (0.85, 0.95), in the third column and the third row of packets.
  const ObjectRecord record = triangle({0.85, 0.95, 0.01}, {3, 0.6, 0.01}, {3, 1.3, 0.01});
  for (const double height : {30.0, 3e4}) {
    Random random(124);
    ShadowBundle shadows(random, Vec3(0), 1, {2, 2, height});
    start_on_grid(shadows);
    const LightBundle<Simd> bundle(shadows.place, shadows.queries, kPackets);
    REQUIRE(bundle.packets == 0xFFFF);
    REQUIRE(bundle.turned == (height == 30.0));
    LeafTriangles<Simd> leaf(&record);
    leaf.add(0);
    leaf.fill();
    const TriangleCulling<Simd> viewed(leaf.sides(), bundle.view);
    CHECK(viewed.seen_by(0, bundle.view) == (1u << 10 | 1u << 11));
  }
}

TEST_CASE("Packets are incoherent that cover much more of a light's view than their shares") {
  for (const double height : {30.0, 3e4}) {
    Random random(125);
    ShadowBundle shadows(random, Vec3(0), 1, {2, 2, height});
    start_on_grid(shadows);
    CHECK(LightBundle<Simd>(shadows.place, shadows.queries, kPackets).incoherent == 0);
    shadows.start_at({0, 0, 0}, 5, 0);
    shadows.start_at({1.5, 1.5, 0}, 5, 15);
    CHECK(LightBundle<Simd>(shadows.place, shadows.queries, kPackets).incoherent == 1u << 5);
  }
}

TEST_CASE("Light comes to a bundle as it comes to its packets") {
  Random random(122);
  int dark = 0, bright = 0;
  // An opaque plane leaves some packets without rays, and a translucent one dims others.
  Scene with_planes = soup(43, {0, 0, 400}, 10, 1);
  with_planes.objects.push_back(with_planes.objects.front());
  with_planes.objects.back().shape = Plane{{1, 2, 0}, -5};
  with_planes.objects.back().material = 0;
  with_planes.objects.push_back(with_planes.objects.back());
  with_planes.objects.back().shape = Plane{{0, 0, 1}, 7};
  with_planes.objects.back().material = 5;
  for (const Scene& scene : {soup(40, {0, 0, 400}, 10, 1), soup(41, {60, 60, 60}, 10, 1),
                             soup(42, {0, 0, 30}, 10, 4), with_planes})
    for (const bool large_leaves : {false, true}) {
      PreparedScene prepared(scene);
      prepared.use_bvh(large_leaves, !large_leaves);
      REQUIRE(prepared.prepare().built);
      FrameBlock& frame = prepared.frame();
      for (int k = 0; k < times(300); ++k)
        with_two_bundles(random, frame,
                         [&](ShadowTraversal& traversal, const LightRecord& light, ShadowBundle& together,
                             ShadowBundle& alone) {
                           traversal.intersect(together.queries, kPackets, light);
                           for (std::uint32_t i = 0; i < kPackets; ++i) {
                             traversal.transmittance(alone.rays[i], alone.queries[i].lanes, alone.distance[i],
                                                     alone.light[i]);
                             for_each_lane(alone.queries[i].lanes, [&](std::uint32_t lane) {
                               for (int c = 0; c < 3; ++c)
                                 REQUIRE(at(together.light[i], lane)[c] ==
                                         Approx(at(alone.light[i], lane)[c]).margin(1e-6));
                               ++(alone.light[i].y.lane[lane] == 0 ? dark : bright);
                             });
                           }
                         });
    }
  CHECK(dark > times(8000));
  CHECK(bright > times(8000));
}

TEST_CASE("What shadow rays cross of translucent objects is listed in the order in which they cross it") {
  Random random(123);
  int listed = 0, dark = 0, clear = 0;
  for (const Scene& scene : {soup(41, {60, 60, 60}, 10, 1), soup(43, {0, 0, 200}, 10, 2)}) {
    PreparedScene prepared(scene);
    prepared.use_bvh(true, false);
    REQUIRE(prepared.prepare().built);
    FrameBlock& frame = prepared.frame();
    for (int k = 0; k < times(200); ++k)
      with_two_bundles(
          random, frame,
          [&](ShadowTraversal& traversal, const LightRecord& light, ShadowBundle& bundle,
              ShadowBundle& alone) {
            auto pool = std::make_unique<CrossingPool>();
            auto kept = std::make_unique<CrossingList<Simd>[]>(kPackets);
            std::uint32_t asked[kPackets];
            VectorLanes whole[kPackets];
            for (std::uint32_t i = 0; i < kPackets; ++i) {
              asked[i] = alone.queries[i].lanes;
              whole[i] = alone.light[i];
              traversal.transmittance(alone.rays[i], asked[i], alone.distance[i], alone.light[i]);
              kept[i].begin(bundle.light[i], *pool);
              bundle.queries[i].light = &kept[i];
            }
            if (k % 2 == 0)
              traversal.collect_crossings(bundle.queries, kPackets, light, true);
            else
              for (RayQuery& query : bundle.queries)
                traversal.collect_crossings(query, true);
            for (const RayQuery& query : bundle.queries) {
              auto& crossings = static_cast<CrossingList<Simd>&>(*query.light);
              const auto i = static_cast<std::size_t>(&crossings - kept.get());
              const std::uint32_t known = asked[i] & ~crossings.overflowed;
              for_each_lane(known & ~query.lanes,
                            [&](std::uint32_t lane) { CHECK(at(alone.light[i], lane) == Vec3(0)); });
              dark += std::popcount(known & ~query.lanes);
              HitPacket hits;
              VectorLanes transmittance;
              FloatLanes last = {};
              std::uint32_t crossing = 0;
              for (std::uint32_t lanes = known & query.lanes; lanes != 0;) {
                lanes = crossings.take(lanes, hits, transmittance);
                crossing |= lanes;
                for_each_lane(lanes, [&](std::uint32_t lane) {
                  CHECK(hits.distance.lane[lane] >= last.lane[lane]);
                  CHECK(hits.distance.lane[lane] < alone.distance[i].lane[lane]);
                  last.lane[lane] = hits.distance.lane[lane];
                  CHECK((reinterpret_cast<const ObjectRecord*>(frame.image + hits.object.lane[lane])
                             ->kind_and_flags &
                         object_flag::opaque) == 0);
                });
              }
              for_each_lane(known & query.lanes, [&](std::uint32_t lane) {
                const bool comes_whole = at(alone.light[i], lane) == at(whole[i], lane);
                CHECK(comes_whole == ((crossing >> lane & 1) == 0));
              });
              listed += std::popcount(crossing);
              clear += std::popcount(known & query.lanes & ~crossing);
            }
          });
  }
  CHECK(listed > times(2000));
  CHECK(dark > times(2000));
  CHECK(clear > times(2000));
}
