// Rays that leave the packets that they began in: pools of secondary rays, queues of hits and shadow rays,
// and hits sorted by materials.
#include "direct_spu.hpp"
#include "kernel/direct/hit_queue.hpp"
#include "kernel/direct/hit_sorting.hpp"
#include "kernel/direct/ray_pool.hpp"
#include "kernel/direct/shadow_queue.hpp"
#include "kernel/direct/sky_queue.hpp"
#include "lanes.hpp"
#include "prepared_scene.hpp"
#include "soups.hpp"

#include <catch2/catch.hpp>

#include <cstring>
#include <set>
#include <vector>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// Some rays, each with its number in all that it brings along.
std::uint32_t next_number = 0;
RayNode node_of(Random& random, std::uint32_t lanes, WordLanes& pixels) {
  RayNode node = {};
  node.lanes = lanes;
  for_each_lane(lanes, [&](std::uint32_t lane) {
    const auto number = static_cast<float>(next_number);
    set(node.rays.origin, lane, {number, number, number});
    set(node.rays.direction, lane, random.direction());
    set(node.throughput, lane, {number + 1, number + 2, number + 3});
    node.rays.start_object.lane[lane] = next_number;
    node.weight.lane[lane] = number;
    node.power.lane[lane] = number;
    node.level.lane[lane] = next_number % 5;
    node.interior_depth.lane[lane] = next_number % 3;
    for (std::uint32_t i = 0; i < next_number % 3; ++i)
      node.interiors[i].lane[lane] = next_number + i;
    node.reflected |= (next_number & 1) << lane;
    pixels.lane[lane] = next_number++;
  });
  return node;
}

void check_ray(const PooledPacket& packet, std::uint32_t lane) {
  const RayNode& node = packet.node;
  const std::uint32_t number = packet.pixels.lane[lane];
  const auto value = static_cast<float>(number);
  REQUIRE(node.rays.origin.y.lane[lane] == value);
  REQUIRE(node.rays.start_object.lane[lane] == number);
  REQUIRE(node.throughput.z.lane[lane] == value + 3);
  REQUIRE(node.weight.lane[lane] == value);
  REQUIRE(node.power.lane[lane] == value);
  REQUIRE(node.level.lane[lane] == number % 5);
  REQUIRE(node.interior_depth.lane[lane] == number % 3);
  for (std::uint32_t i = 0; i < number % 3; ++i)
    REQUIRE(node.interiors[i].lane[lane] == number + i);
  REQUIRE((node.reflected >> lane & 1) == (number & 1));
}

} // namespace

TEST_CASE("A pool of rays gives back each of them once, with all that belongs to it") {
  DirectSpu spu;
  RayPool<DirectSpu> pool(spu);
  Random random(5);
  for (int round = 0; round < 20; ++round) {
    std::set<std::uint32_t> inside;
    for (int step = 0; step < 400; ++step) {
      if (random.below(3) != 0) {
        WordLanes pixels = {};
        std::uint32_t lanes = 0;
        for (unsigned i = random.below(11) + 1; i != 0; --i)
          lanes |= 1u << random.below(kSimdLanes);
        const RayNode node = node_of(random, lanes, pixels);
        if (!pool.add(node, pixels)) continue;
        for_each_lane(lanes, [&](std::uint32_t lane) { REQUIRE(inside.insert(pixels.lane[lane]).second); });
      } else if (!pool.empty()) {
        const PooledPacket& packet = pool.take();
        REQUIRE(packet.node.lanes != 0);
        for_each_lane(packet.node.lanes, [&](std::uint32_t lane) {
          check_ray(packet, lane);
          REQUIRE(inside.erase(packet.pixels.lane[lane]) == 1);
        });
      }
    }
    if (round % 4 == 3) {
      pool.clear();
      REQUIRE(pool.empty());
      continue;
    }
    while (!pool.empty()) {
      const PooledPacket& packet = pool.take();
      for_each_lane(packet.node.lanes,
                    [&](std::uint32_t lane) { REQUIRE(inside.erase(packet.pixels.lane[lane]) == 1); });
    }
    REQUIRE(inside.empty());
  }
}

TEST_CASE("A queue of hits gives each of them once, with its ray, in full packets") {
  DirectSpu spu;
  HitQueue<DirectSpu> queue(spu);
  Random random(11);
  std::set<std::uint32_t> inside;
  int refused = 0;
  const auto take = [&] {
    const auto left = static_cast<unsigned>(inside.size());
    const QueuedHits& queued = queue.take();
    const std::uint32_t lanes = queued.packet.node.lanes;
    REQUIRE(lanes == (left < kSimdLanes ? (1u << left) - 1 : 0xFFFF));
    for_each_lane(lanes, [&](std::uint32_t lane) {
      check_ray(queued.packet, lane);
      const std::uint32_t number = queued.packet.pixels.lane[lane];
      const auto value = static_cast<float>(number);
      REQUIRE(inside.erase(number) == 1);
      REQUIRE(queued.hits.object.lane[lane] == 2 * number);
      REQUIRE(queued.hits.distance.lane[lane] == value);
      REQUIRE(queued.hits.u.lane[lane] == value + 1);
      REQUIRE(queued.hits.v.lane[lane] == value + 2);
    });
  };
  for (int step = 0; step < 600; ++step) {
    const std::uint32_t lanes = random.word() & random.word() & 0xFFFF;
    WordLanes pixels = {};
    HitPacket hits = {};
    const RayNode node = node_of(random, lanes, pixels);
    for_each_lane(lanes, [&](std::uint32_t lane) {
      const auto value = static_cast<float>(pixels.lane[lane]);
      hits.object.lane[lane] = 2 * pixels.lane[lane];
      hits.distance.lane[lane] = value;
      hits.u.lane[lane] = value + 1;
      hits.v.lane[lane] = value + 2;
    });
    if (queue.add(node, pixels, hits, lanes))
      for_each_lane(lanes, [&](std::uint32_t lane) { inside.insert(pixels.lane[lane]); });
    else
      ++refused;
    REQUIRE(queue.full() == (inside.size() >= kSimdLanes));
    REQUIRE(queue.empty() == inside.empty());
    if (queue.full() && random.below(6) == 0) take();
    if (step % 100 != 99) continue;
    queue.clear();
    inside.clear();
    REQUIRE(queue.empty());
  }
  while (!queue.empty())
    take();
  CHECK(inside.empty());
  CHECK(refused > 10);
  WordLanes pixels = {};
  const RayNode node = node_of(random, 0xFFFF, pixels);
  CHECK_FALSE(queue.add(node, pixels, {}, 0xFFFF));
}

TEST_CASE("A queue of shadow rays gives each point once, with all that belongs to it, in full packets") {
  using S = DirectSpu::simd;
  DirectSpu spu;
  ShadowQueue<DirectSpu> queue(spu);
  Random random(8);
  for (const bool with_interiors : {false, true}) {
    std::set<std::uint32_t> inside[3];
    const auto check = [&](std::uint32_t light, const QueuedPoints& points, std::uint32_t lanes) {
      for_each_lane(lanes, [&](std::uint32_t lane) {
        const std::uint32_t number = points.pixels.lane[lane];
        const auto value = static_cast<float>(number);
        REQUIRE(inside[light].erase(number) == 1);
        REQUIRE(points.point.z.lane[lane] == value);
        REQUIRE(points.object.lane[lane] == number);
        REQUIRE(points.light.x.lane[lane] == value + 1);
        REQUIRE(points.light.z.lane[lane] == value + 3);
        if (!with_interiors) return;
        REQUIRE(points.interiors.interior_depth.lane[lane] == number % 3);
        for (std::uint32_t i = 0; i < number % 3; ++i)
          REQUIRE(points.interiors.interiors[i].lane[lane] == number + i);
      });
    };
    for (int step = 0; step < 400; ++step) {
      const std::uint32_t light = random.below(3), lanes = random.below(0x10000);
      if (!queue.takes(light, lanes)) continue;
      WordLanes pixels = {};
      const RayNode node = node_of(random, lanes, pixels);
      for_each_lane(lanes, [&](std::uint32_t lane) { inside[light].insert(pixels.lane[lane]); });
      queue.add(light, lanes, node.rays.origin.load<S>(), node.rays.start_object, node.throughput, pixels,
                with_interiors ? &node : nullptr,
                [&](const QueuedPoints& points) { check(light, points, 0xFFFF); });
      REQUIRE(inside[light].size() < kSimdLanes);
    }
    queue.finish(check);
    for (const auto& left : inside)
      REQUIRE(left.empty());
    queue.finish([](std::uint32_t, const QueuedPoints&, std::uint32_t) { FAIL("nothing is left"); });
  }
}

TEST_CASE("A queue of shadow rays refuses packets with many, lights of high numbers, and forgets all") {
  DirectSpu spu;
  ShadowQueue<DirectSpu> queue(spu);
  Random random(9);
  CHECK(queue.takes(0, 0x00FF));
  CHECK_FALSE(queue.takes(0, 0xFFFF));
  CHECK_FALSE(queue.takes(1000, 1));
  WordLanes pixels = {};
  const RayNode node = node_of(random, 0xFF, pixels);
  const auto none = [](const QueuedPoints&) { FAIL("no packet is full"); };
  queue.add(2, 0xFF, node.rays.origin.load<DirectSpu::simd>(), node.rays.start_object, node.throughput,
            pixels, nullptr, none);
  queue.clear();
  queue.finish([](std::uint32_t, const QueuedPoints&, std::uint32_t) { FAIL("nothing is left"); });
}

TEST_CASE("A queue of rays to the sky gives each of them once, in full packets") {
  DirectSpu spu;
  SkyQueue<DirectSpu> queue(spu);
  Random random(10);
  CHECK(queue.takes(0x00FF));
  CHECK_FALSE(queue.takes(0xFFFF));
  std::set<std::uint32_t> inside;
  const auto check = [&](const SkyRays& rays, std::uint32_t lanes) {
    for_each_lane(lanes, [&](std::uint32_t lane) {
      const std::uint32_t number = rays.pixels.lane[lane];
      REQUIRE(inside.erase(number) == 1);
      REQUIRE(rays.throughput.x.lane[lane] == static_cast<float>(number) + 1);
      REQUIRE(rays.throughput.z.lane[lane] == static_cast<float>(number) + 3);
      REQUIRE(glm::length(at(rays.direction, lane)) == Approx(1));
    });
  };
  for (int step = 0; step < 400; ++step) {
    WordLanes pixels = {};
    const std::uint32_t lanes = random.below(0x10000);
    const RayNode node = node_of(random, lanes, pixels);
    for_each_lane(lanes, [&](std::uint32_t lane) { inside.insert(pixels.lane[lane]); });
    queue.add(node, pixels, lanes, [&](const SkyRays& rays) { check(rays, 0xFFFF); });
    REQUIRE(inside.size() < kSimdLanes);
    if (step % 50 != 49) continue;
    queue.clear();
    inside.clear();
  }
  WordLanes pixels = {};
  const RayNode node = node_of(random, 0x0413, pixels);
  for_each_lane(0x0413, [&](std::uint32_t lane) { inside.insert(pixels.lane[lane]); });
  queue.add(node, pixels, 0x0413, [](const SkyRays&) { FAIL("no packet is full"); });
  queue.finish(check);
  CHECK(inside.empty());
  queue.finish([](const SkyRays&, std::uint32_t) { FAIL("nothing is left"); });
}

TEST_CASE("Full packets of a pool have rays of one octant and come first") {
  DirectSpu spu;
  RayPool<DirectSpu> pool(spu);
  Random random(6);
  WordLanes pixels = {};
  for (int i = 0; i < 40; ++i)
    REQUIRE(pool.add(node_of(random, 0x1248u << (i % 4), pixels), pixels));
  bool only_rest = false;
  while (!pool.empty()) {
    const PooledPacket& packet = pool.take();
    std::set<std::uint32_t> octants;
    for_each_lane(packet.node.lanes,
                  [&](std::uint32_t lane) { octants.insert(octant_of(packet.node.rays, lane)); });
    if (packet.node.lanes == 0xFFFF && octants.size() == 1) {
      CHECK_FALSE(only_rest);
      continue;
    }
    only_rest = true;
  }
}

TEST_CASE("A pool refuses rays that fill a packet by themselves, and those that it has no room for") {
  DirectSpu spu;
  RayPool<DirectSpu> pool(spu);
  Random random(7);
  WordLanes pixels = {};
  CHECK_FALSE(pool.add(node_of(random, 0xFFFF, pixels), pixels));
  CHECK(pool.empty());
  std::uint32_t taken = 0, added = 0;
  while (pool.add(node_of(random, 0xFF, pixels), pixels))
    added += 8;
  CHECK(added > 40 * kSimdLanes);
  CHECK_FALSE(pool.add(node_of(random, 1, pixels), pixels));
  while (!pool.empty())
    taken += static_cast<std::uint32_t>(__builtin_popcount(pool.take().node.lanes));
  CHECK(taken == added);
  CHECK(pool.add(node_of(random, 1, pixels), pixels));
}

namespace {

constexpr std::uint32_t kPackets = kBundlePackets<DirectSpu>;

/// A bundle whose rays bear their places, and the objects of a scene in some pattern.
struct Bundle {
  struct Packet {
    RayPacket rays;
    HitPacket hits;
    std::uint32_t lanes;
  };
  Packet packets[kPackets];

  template <class ObjectOf> explicit Bundle(const ObjectOf& object_of) {
    for (std::uint32_t i = 0; i < kPackets; ++i) {
      packets[i] = {};
      packets[i].lanes = 0xFFFF;
      for (std::uint32_t lane = 0; lane < kSimdLanes; ++lane) {
        const auto place = static_cast<float>(i * kSimdLanes + lane);
        set(packets[i].rays.origin, lane, {place, 1, 2});
        set(packets[i].rays.direction, lane, {3, place, 4});
        packets[i].hits.distance.lane[lane] = place;
        packets[i].hits.object.lane[lane] = object_of(i, lane);
      }
    }
  }
};

} // namespace

TEST_CASE("Hits are sorted by materials, and their rays know where they were") {
  const Scene source = soup(3, {40, 0, 0}, 5, 4);
  PreparedScene scene(source);
  DirectSpu spu;
  SceneAccess<DirectSpu> access(spu, CacheConfig(), scene.frame().image);
  HitSorter<DirectSpu> sorter(spu);
  std::vector<std::uint32_t> objects; // one of each material
  std::set<std::uint32_t> materials;
  for (std::uint32_t i = 0; i < scene.object_count(); ++i)
    if (materials.insert(scene.object(i).material).second) objects.push_back(scene.object_offset(i));
  REQUIRE(objects.size() >= 3);
  const auto material_of = [&](std::uint32_t object) {
    return object == kNoOffset ? kNoOffset : access.object(object)->material;
  };
  const auto mixed_of = [&](const Bundle& bundle) {
    unsigned sum = 0;
    for (const Bundle::Packet& packet : bundle.packets) {
      std::set<std::uint32_t> of_packet;
      for_each_lane(packet.lanes, [&](std::uint32_t lane) {
        if (packet.hits.object.lane[lane] != kNoOffset)
          of_packet.insert(material_of(packet.hits.object.lane[lane]));
      });
      sum += static_cast<unsigned>(of_packet.size());
    }
    return sum;
  };

  /// How many rays of sorted packets are there, each of them once and with all that it had.
  const auto rays_found = [&](const Bundle& before, const Bundle& bundle, std::uint32_t sorted) {
    std::set<std::uint32_t> seen;
    for_each_lane(sorted, [&](std::uint32_t i) {
      for_each_lane(bundle.packets[i].lanes, [&](std::uint32_t lane) {
        const std::uint32_t place = sorter.places(i).lane[lane], was = place % kSimdLanes;
        const Bundle::Packet &from = before.packets[place / kSimdLanes], &to = bundle.packets[i];
        REQUIRE((from.lanes >> was & 1) == 1);
        REQUIRE(seen.insert(place).second);
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
          REQUIRE(to.rays.origin[axis].lane[lane] == from.rays.origin[axis].lane[was]);
          REQUIRE(to.rays.direction[axis].lane[lane] == from.rays.direction[axis].lane[was]);
        }
        REQUIRE(to.rays.start_object.lane[lane] == from.rays.start_object.lane[was]);
        REQUIRE(to.hits.distance.lane[lane] == static_cast<float>(place));
        REQUIRE(to.hits.object.lane[lane] == from.hits.object.lane[was]);
        REQUIRE(to.hits.u.lane[lane] == from.hits.u.lane[was]);
        REQUIRE(to.hits.v.lane[lane] == from.hits.v.lane[was]);
      });
    });
    return seen.size();
  };

  SECTION("where packets have several") {
    Bundle bundle([&](std::uint32_t i, std::uint32_t lane) {
      return (lane + i) % 4 == 3 ? kNoOffset : objects[(lane + i) % 4 % 3];
    });
    bundle.packets[5].lanes = 0x00F1;
    bundle.packets[kPackets - 1].lanes = 0;
    const Bundle before = bundle;
    const std::uint32_t sorted = sorter.sort(access, bundle.packets);
    CHECK(sorted == (1u << (kPackets - 1)) - 1);
    CHECK(mixed_of(bundle) * 2 < mixed_of(before));
    CHECK(rays_found(before, bundle, sorted) == (kPackets - 2) * kSimdLanes + 5);
  }
  SECTION("where some packets have several, and others stay as they are") {
    const bool same_start = GENERATE(false, true), has_coordinates = GENERATE(false, true);
    Bundle bundle(
        [&](std::uint32_t i, std::uint32_t lane) { return objects[i % 2 == 0 ? (lane + lane / 8) % 3 : 1]; });
    for (std::uint32_t i = 0; i < kPackets; ++i)
      for (std::uint32_t lane = 0; lane < kSimdLanes; ++lane) {
        Bundle::Packet& packet = bundle.packets[i];
        if (same_start) set(packet.rays.origin, lane, {5, 6, 7});
        packet.rays.start_object.lane[lane] = same_start ? kNoOffset : i;
        if (has_coordinates) packet.hits.v.lane[lane] = packet.hits.distance.lane[lane] / 1000;
      }
    const Bundle before = bundle;
    const std::uint32_t sorted = sorter.sort(access, bundle.packets);
    CHECK(sorted == 0x5555u % (1u << kPackets));
    CHECK(rays_found(before, bundle, sorted) == kPackets / 2 * kSimdLanes);
    for (std::uint32_t i = 1; i < kPackets; i += 2)
      CHECK(std::memcmp(&bundle.packets[i], &before.packets[i], sizeof before.packets[i]) == 0);
  }
  SECTION("but not where each packet has one") {
    Bundle bundle([&](std::uint32_t i, std::uint32_t) { return objects[i % 3]; });
    CHECK_FALSE(sorter.sort(access, bundle.packets));
    for (std::uint32_t i = 0; i < kPackets; ++i)
      CHECK(bundle.packets[i].rays.origin.x.lane[3] == static_cast<float>(i * kSimdLanes + 3));
  }
  SECTION("nor where few packets have several") {
    Bundle bundle([&](std::uint32_t i, std::uint32_t lane) { return objects[i == 0 ? lane % 3 : 0]; });
    CHECK_FALSE(sorter.sort(access, bundle.packets));
  }
}
