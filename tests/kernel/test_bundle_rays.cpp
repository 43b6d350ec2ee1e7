// Rays that leave the packets that they began in: the kinds of work that they wait for, and hits sorted by
// materials.
#include "direct_spu.hpp"
#include "kernel/direct/bundle_queues.hpp"
#include "kernel/direct/hit_sorting.hpp"
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

void check_ray(const PooledRays& packet, std::uint32_t lane) {
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

/// Stands for the trees that do the work: checks it, and notes which numbers it was of.
struct Worker {
  bool with_interiors = true;
  std::set<std::uint32_t> seen;
  int full = 0;

  void note(std::uint32_t number) { REQUIRE(seen.insert(number).second); }
  void note_packet(std::uint32_t lanes) { full += lanes == 0xFFFF ? 1 : 0; }

  bool trace_pooled(const PooledRays& rays, std::uint32_t lanes, int) {
    REQUIRE(rays.node.lanes == lanes);
    REQUIRE(rays.node.target == 0);
    note_packet(lanes);
    for_each_lane(lanes, [&](std::uint32_t lane) {
      check_ray(rays, lane);
      note(rays.pixels.lane[lane]);
    });
    std::set<std::uint32_t> octants;
    for_each_lane(lanes, [&](std::uint32_t lane) { octants.insert(octant_of(rays.node.rays, lane)); });
    return octants.size() == 1;
  }
  void shade_ending(const EndingHits& ending, std::uint32_t lanes) {
    REQUIRE(ending.rays.node.lanes == lanes);
    note_packet(lanes);
    for_each_lane(lanes, [&](std::uint32_t lane) {
      check_ray(ending.rays, lane);
      const std::uint32_t number = ending.rays.pixels.lane[lane];
      const auto value = static_cast<float>(number);
      REQUIRE(ending.hits.object.lane[lane] == 2 * number);
      REQUIRE(ending.hits.distance.lane[lane] == value);
      REQUIRE(ending.hits.u.lane[lane] == value + 1);
      REQUIRE(ending.hits.v.lane[lane] == value + 2);
      note(number);
    });
  }
  void light_points(std::uint32_t light, const ShadowPoints& points, std::uint32_t lanes) {
    note_packet(lanes);
    for_each_lane(lanes, [&](std::uint32_t lane) {
      const std::uint32_t number = points.pixels.lane[lane];
      const auto value = static_cast<float>(number);
      REQUIRE(number % 3 == light);
      REQUIRE(points.point.z.lane[lane] == value);
      REQUIRE(points.object.lane[lane] == number);
      REQUIRE(points.light.x.lane[lane] == value + 1);
      REQUIRE(points.light.z.lane[lane] == value + 3);
      note(number);
      if (!with_interiors) return;
      REQUIRE(points.interiors.interior_depth.lane[lane] == number % 3);
      for (std::uint32_t i = 0; i < number % 3; ++i)
        REQUIRE(points.interiors.interiors[i].lane[lane] == number + i);
    });
  }
  void see_sky(const SkyRays& rays, std::uint32_t lanes) {
    note_packet(lanes);
    for_each_lane(lanes, [&](std::uint32_t lane) {
      const std::uint32_t number = rays.pixels.lane[lane];
      REQUIRE(rays.throughput.x.lane[lane] == static_cast<float>(number) + 1);
      REQUIRE(rays.throughput.z.lane[lane] == static_cast<float>(number) + 3);
      REQUIRE(glm::length(at(rays.direction, lane)) == Approx(1));
      note(number);
    });
  }
};

template <class Kind> struct Queue : WavefrontQueue<Kind> {
  explicit Queue(DirectSpu& spu) : WavefrontQueue<Kind>(spu.allocate<Kind>(Kind::kPackets)) {}
};

} // namespace

TEST_CASE("Rays that wait bring all that belongs to them, and full packets are of one octant") {
  DirectSpu spu;
  Queue<PooledRays> queue(spu);
  RayPooling pooling = {&queue, {}};
  Random random(5);
  Worker worker;
  std::uint32_t taken = 0;
  next_number = 0;
  for (int step = 0; step < 2000; ++step) {
    std::uint32_t lanes = 0;
    for (unsigned i = random.below(11) + 1; i != 0; --i)
      lanes |= 1u << random.below(kSimdLanes);
    const RayNode node = node_of(random, lanes, pooling.pixels);
    REQUIRE(pooling.takes(node));
    taken += static_cast<std::uint32_t>(__builtin_popcount(lanes));
    while (queue.has_full())
      REQUIRE(queue.run_next(worker, 0));
  }
  queue.flush(worker, 0);
  CHECK(worker.seen.size() == taken);
  CHECK(worker.full > 500);
}

TEST_CASE("Rays stay that fill a packet by themselves, and those for which there is no room") {
  DirectSpu spu;
  Queue<PooledRays> queue(spu);
  RayPooling pooling = {&queue, {}};
  Random random(7);
  Worker worker;
  CHECK_FALSE(pooling.takes(node_of(random, 0xFFFF, pooling.pixels)));
  CHECK(queue.empty());
  std::uint32_t added = 0;
  while (pooling.takes(node_of(random, 0xFF, pooling.pixels)))
    added += 8;
  CHECK(added > 40 * kSimdLanes);
  CHECK_FALSE(pooling.takes(node_of(random, 1, pooling.pixels)));
  queue.flush(worker, 0);
  CHECK(worker.seen.size() == added);
  CHECK(pooling.takes(node_of(random, 1, pooling.pixels)));
  CHECK_FALSE(RayPooling().takes(node_of(random, 1, pooling.pixels)));
}

TEST_CASE("Hits, points and rays to the sky that wait bring all that belongs to them") {
  DirectSpu spu;
  Queue<EndingHits> hits(spu);
  Queue<ShadowPoints> shadows(spu);
  Queue<SkyRays> skies(spu);
  Random random(11);
  Worker of_hits, of_shadows, of_skies;
  of_shadows.with_interiors = GENERATE(false, true);
  next_number = 0;
  for (int step = 0; step < 600; ++step) {
    const std::uint32_t lanes = random.word() & random.word() & 0xFFFF;
    WordLanes pixels = {};
    HitPacket hit = {};
    const RayNode node = node_of(random, lanes, pixels);
    std::uint32_t of_light[3] = {};
    for_each_lane(lanes, [&](std::uint32_t lane) {
      const auto value = static_cast<float>(pixels.lane[lane]);
      hit.object.lane[lane] = 2 * pixels.lane[lane];
      hit.distance.lane[lane] = value;
      hit.u.lane[lane] = value + 1;
      hit.v.lane[lane] = value + 2;
      of_light[pixels.lane[lane] % 3] |= 1u << lane;
    });
    hits.push(0, lanes, {{node, pixels}, hit});
    while (hits.has_full())
      hits.run_next(of_hits);
    skies.push(0, lanes, {node, pixels}, of_skies);
    for (std::uint32_t light = 0; light < 3; ++light)
      shadows.push(light, of_light[light],
                   {node.rays.origin, node.rays.start_object, node.throughput, pixels,
                    of_shadows.with_interiors ? &node : nullptr},
                   of_shadows);
  }
  hits.flush(of_hits);
  shadows.flush(of_shadows);
  skies.flush(of_skies);
  for (const Worker* worker : {&of_hits, &of_shadows, &of_skies}) {
    CHECK(worker->seen.size() == next_number);
    CHECK(worker->full >= static_cast<int>(next_number / kSimdLanes) - 2);
  }
}

TEST_CASE("Twelve lanes of a packet do not wait") {
  CHECK(had_better_wait(0x07FF));
  CHECK_FALSE(had_better_wait(0x0FFF));
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
