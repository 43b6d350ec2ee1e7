// The leaves of a small BVH, tested one after the other: against tests of all objects.
#include "compiled_once.hpp"
#include "kernel/direct/leaf_list.hpp"
#include "lanes.hpp"
#include "prepared_scene.hpp"
#include "soups.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <vector>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

RayPacket random_rays(Random& random) {
  RayPacket rays;
  for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
    set(rays.origin, lane, random.point(3));
    set(rays.direction, lane,
        random.below(8) == 0 ? Vec3(0, random.below(2) == 0 ? 1 : -1, 0) : random.direction());
    rays.start_object.lane[lane] = kNoOffset;
  }
  return rays;
}

} // namespace

TEST_CASE("All leaves one after the other answer what all objects do") {
  Random random(170);
  int hits = 0, occluded = 0;
  std::vector<Scene> scenes;
  for (const SoupKinds& kinds : {SoupKinds{12, 0, 0}, {9, 6, 0}, {8, 8, 8}, {0, 0, 24}})
    scenes.push_back(soup(random.below(1000), kinds, 3, 1.5));
  // Leaves that share slabs.
  scenes.push_back(soup(7, {18, 0, 0}, 3, 1.5));
  for (std::size_t i = 0; i < scenes.back().objects.size(); ++i)
    scenes.back().objects[i].shape =
        Sphere{2.0 * Vec3(static_cast<double>(i % 3) - 1, static_cast<double>(i / 3 % 3) - 1, i < 9 ? -1 : 1),
               i % 2 == 0 ? 0.5 : 0.8};
  for (const Scene& of_objects : scenes) {
    PreparedScene scene(of_objects);
    scene.use_bvh(true);
    REQUIRE(scene.prepare().built);
    const FrameBlock& frame = scene.frame();
    DirectSpu spu;
    SceneAccess<DirectSpu> access(spu, CacheConfig::off(), frame.image);
    const auto objects = std::make_unique<ObjectTests<DirectSpu>>(access);
    const auto traversal = std::make_unique<PacketTraversal<DirectSpu>>(*objects, frame);
    const auto leaves = std::make_unique<LeafList<DirectSpu>>();
    const NodeRef root = {frame.bvh.node_offset, 0};
    REQUIRE_FALSE(leaves->pays(access, root));
    for (int round = 0; round < times(100); ++round) {
      const RayPacket rays = random_rays(random);
      const std::uint32_t lanes = random.word() & 0xFFFF;
      HitPacket found, expected;
      for (HitPacket* packet : {&found, &expected}) {
        Simd::F(kMaxHitDistance).store(packet->distance.lane);
        store_words<Simd>(packet->object, Simd::I::splat(-1));
      }
      RayQuery query = {&rays, &found, nullptr, nullptr, lanes},
               of_all = {&rays, &expected, nullptr, nullptr, lanes};
      objects->hit_filter().begin_packet();
      leaves->intersect(*traversal, query);
      objects->test_list(frame.object_offset, frame.object_count, of_all);
      for_each_lane(lanes, [&](unsigned lane) {
        REQUIRE(found.object.lane[lane] == expected.object.lane[lane]);
        REQUIRE(found.distance.lane[lane] == expected.distance.lane[lane]);
        hits += found.distance.lane[lane] < kMaxHitDistance;
      });

      FloatLanes distance;
      VectorLanes light, light_of_all;
      Simd::F(static_cast<float>(random.uniform(0.5, 6))).store(distance.lane);
      for (VectorLanes* packet : {&light, &light_of_all})
        packet->store<Simd>({Simd::F(1.0f), Simd::F(1.0f), Simd::F(1.0f)});
      query = {&rays, nullptr, &distance, &light, lanes};
      of_all = {&rays, nullptr, &distance, &light_of_all, lanes};
      objects->hit_filter().begin_packet();
      leaves->intersect(*traversal, query);
      objects->test_list(frame.object_offset, frame.object_count, of_all);
      REQUIRE(query.lanes == of_all.lanes);
      occluded += __builtin_popcount(lanes & ~query.lanes);
      for_each_lane(query.lanes, [&](unsigned lane) {
        REQUIRE(glm::length(at(light, lane) - at(light_of_all, lane)) < 1e-6);
      });
    }
  }
  CHECK(hits > times(300));
  CHECK(occluded > times(100));
}

TEST_CASE("Leaves are tested one after the other where traversals expand many nodes") {
  for (const bool is_long : {false, true}) {
    PreparedScene scene(soup(171, {is_long ? 200u : 20u, 0, 0}, 3, 1.5));
    scene.use_bvh(true);
    REQUIRE(scene.prepare().built);
    DirectSpu spu;
    SceneAccess<DirectSpu> access(spu, CacheConfig::off(), scene.frame().image);
    LeafList<DirectSpu> leaves;
    const NodeRef root = {scene.frame().bvh.node_offset, 0};
    // How many of many packets are tested so, each of which would expand so many nodes.
    const auto tested = [&](std::uint64_t visits) {
      int packets = 0;
      for (int i = 0; i < 3000; ++i)
        if (leaves.pays(access, root))
          ++packets;
        else
          leaves.count_visits(visits);
      return packets;
    };
    CHECK(tested(1) == 0);
    leaves.begin_frame();
    CHECK(tested(8) == (is_long ? 0 : 3000 - 2 * 16));
  }
}
