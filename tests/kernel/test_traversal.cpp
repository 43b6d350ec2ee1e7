// Packets through the grid and through the BVH, as every SPU type builds and walks them,
// against brute force over all objects with the same intersection tests: closest hits have to be equal to the
// last bit.
#include "celltrace/spe/program.hpp"
#include "kernel/accel/packet_traversal.hpp"
#include "machines.hpp"
#include "prepared_scene.hpp"
#include "soups.hpp"
#include "traversal_probe.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace celltrace {
SpeProgram traversal_program(); // made by the build
}

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

std::vector<TraversalQuery> queries_for(const PreparedScene& scene, unsigned seed, unsigned packets) {
  Random random(seed);
  const GridRecord& grid = scene.frame().grid;
  Vec3 middle, half;
  for (int i = 0; i < 3; ++i) {
    middle[i] = 0.5 * (double{grid.min[i]} + double{grid.max[i]});
    half[i] = 0.5 * (double{grid.max[i]} - double{grid.min[i]});
  }
  std::vector<TraversalQuery> queries(packets);
  // Half of them have much in common with their neighbours, as the packets of a bundle have.
  constexpr unsigned kNeighbours = 24;
  Vec3 common_aim, common;
  for (unsigned packet = 0; packet < packets; ++packet) {
    TraversalQuery& q = queries[packet];
    const bool neighbour = packet / kNeighbours % 2 == 1;
    const unsigned kind = neighbour ? 0 : random.below(6);
    if (!neighbour || packet % kNeighbours == 0) {
      common_aim = middle + half * random.point(1);
      common = random.direction();
    }
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      Vec3 aim = neighbour ? common_aim + half * random.point(0.03) : middle + half * random.point(1.1);
      Vec3 direction = kind == 0 ? glm::normalize(common + random.point(0.05)) : random.direction();
      if (kind >= 4) { // along an axis; 5: on the border of voxels
        const int axis = static_cast<int>(random.below(3));
        direction = Vec3(0);
        direction[axis] = random.below(2) == 0 ? 1 : -1;
        for (int i = 0; i < 3 && kind == 5; ++i)
          aim[i] = grid.min[i] + grid.cell_size[i] * static_cast<float>(random.below(grid.cells[i] + 1));
      }
      if (kind == 3) direction = glm::normalize(direction * Vec3(1, 1, 1e-5)); // nearly parallel to voxels
      const double back = kind == 1 ? 0 : glm::length(half) * random.uniform(0, kind == 2 ? 20 : 3);
      set(q.rays.origin, l, aim - direction * back);
      set(q.rays.direction, l, direction);
      q.rays.start_object.lane[l] = kNoOffset;
      q.distance.lane[l] = static_cast<float>(glm::length(half) * random.uniform(0, 4));
      set(q.light, l, {1, 0.5, 2});
    }
    q.lanes = random.below(3) == 0 ? random.word() & 0xFFFF : 0xFFFF;
  }
  return queries;
}

/// What an accelerator has to answer to a query.
struct Answer {
  HitPacket hits;
  std::array<Vec3, kSimdLanes> light; ///< what is left of it
};
/// Queries and their answers, by brute force.
struct Round {
  std::vector<TraversalQuery> asked;
  std::vector<Answer> answers;
};

/// Makes of each ray that hit something one that starts there, or a shadow ray that ends a little before or
/// behind.
std::vector<TraversalQuery> continued_from_hits(const Round& round) {
  std::vector<TraversalQuery> queries = round.asked;
  Random random(100);
  for (std::size_t i = 0; i < queries.size(); ++i)
    for_each_lane(queries[i].lanes, [&](unsigned l) {
      TraversalQuery& q = queries[i];
      const HitPacket& hits = round.answers[i].hits;
      const float distance = hits.distance.lane[l];
      if (hits.object.lane[l] == kNoOffset) return;
      if (l % 2 == 0) {
        q.distance.lane[l] = distance + (l % 4 == 0 ? 0.0005f : 0.0015f);
        return;
      }
      set(q.rays.origin, l, at(q.rays.origin, l) + at(q.rays.direction, l) * double{distance});
      set(q.rays.direction, l, random.direction());
      q.rays.start_object.lane[l] = hits.object.lane[l];
    });
  return queries;
}

Vec3 filter_of(const PreparedScene& scene, const ObjectRecord& object, double u, double v) {
  const auto filter = [&](std::uint32_t offset) {
    const auto& m = scene.record<MaterialRecord>(offset);
    return Vec3(m.pigment[0], m.pigment[1], m.pigment[2]) * double{m.filter} + double{m.transmit};
  };
  if ((object.kind_and_flags & object_flag::blended) == 0)
    return filter(material_word::offset(object.material));
  const auto& blend = scene.record<BlendRecord>(material_word::offset(object.material));
  return filter(blend.material[0]) * (1 - u - v) + filter(blend.material[1]) * u +
         filter(blend.material[2]) * v;
}

/// The closest hits, and the light with every crossing of every object once.
Answer brute_force(const PreparedScene& scene, const TraversalQuery& q) {
  Answer answer = {};
  for (unsigned l = 0; l < kSimdLanes; ++l) {
    answer.hits.distance.lane[l] = kMaxHitDistance;
    answer.hits.object.lane[l] = kNoOffset;
    answer.light[l] = at(q.light, l);
  }
  for (std::uint32_t i = 0; i < scene.object_count(); ++i) {
    const ObjectRecord& object = scene.object(i);
    const Crossings<Simd> c = intersect(q.rays, object, scene.object_offset(i));
    const std::uint32_t near_hit = c.near_hit.bits(), far_hit = c.far_hit.bits();
    if (((near_hit | far_hit) & q.lanes) == 0) continue;
    const bool has_shadow = (object.kind_and_flags & object_flag::no_shadow) == 0;
    const FloatLanes near = lanes_of(c.near), far = lanes_of(c.far), u = lanes_of(c.u), v = lanes_of(c.v);
    for_each_lane((near_hit | far_hit) & q.lanes, [&](unsigned l) {
      const auto cross = [&](std::uint32_t hit, float t) {
        if ((hit >> l & 1) == 0) return;
        if (t > kMinHitDistance && t < answer.hits.distance.lane[l]) {
          answer.hits.distance.lane[l] = t;
          answer.hits.object.lane[l] = scene.object_offset(i);
        }
        if (has_shadow && t > 1e-3f && t < q.distance.lane[l] - 1e-3f)
          answer.light[l] *= filter_of(scene, object, u.lane[l], v.lane[l]);
      };
      cross(near_hit, near.lane[l]);
      cross(far_hit, far.lane[l]);
    });
  }
  return answer;
}

Round brute_force(const PreparedScene& scene, std::vector<TraversalQuery> queries) {
  Round round = {std::move(queries), {}};
  for (const TraversalQuery& query : round.asked)
    round.answers.push_back(brute_force(scene, query));
  return round;
}
using Rounds = std::array<Round, 2>;
Rounds rounds_of(const PreparedScene& scene, const std::vector<TraversalQuery>& first) {
  Round one = brute_force(scene, first);
  Round two = brute_force(scene, continued_from_hits(one));
  return {std::move(one), std::move(two)};
}

void check(const TraversalQuery& asked, const Answer& expected, const TraversalQuery& answer) {
  for_each_lane(asked.lanes, [&](unsigned l) {
    INFO("lane " << l << " from " << asked.rays.origin.x.lane[l] << ' ' << asked.rays.origin.y.lane[l] << ' '
                 << asked.rays.origin.z.lane[l] << " along " << asked.rays.direction.x.lane[l] << ' '
                 << asked.rays.direction.y.lane[l] << ' ' << asked.rays.direction.z.lane[l]);
    REQUIRE(answer.hits.distance.lane[l] == expected.hits.distance.lane[l]);
    REQUIRE(answer.hits.object.lane[l] == expected.hits.object.lane[l]);
    const Vec3& light = expected.light[l];
    INFO("light " << light.x << " of 1, distance " << asked.distance.lane[l]);
    for (int i = 0; i < 3; ++i)
      REQUIRE(at(answer.light, l)[i] == Approx(light[i]).epsilon(1e-5).margin(1e-9));
  });
  for (unsigned l = 0; l < kSimdLanes; ++l)
    REQUIRE(at(answer.light, l).y <= 0.5); // nothing else was touched
}

void check_accelerator(PreparedScene& prepared, const Rounds& rounds) {
  const bool bvh = static_cast<AcceleratorKind>(prepared.frame().accelerator) == AcceleratorKind::bvh;
  for (const auto& machine : machines()) {
    if (bvh && machine->backend() != Backend::native) continue;
    INFO(machine->spu_key() << (bvh ? ", BVH" : ", grid"));
    for (const Round& round : rounds)
      for (const std::uint32_t bundles : {0u, 1u}) {
        INFO((bundles != 0 ? "bundles" : "packets"));
        std::vector<TraversalQuery> answers = round.asked;
        const auto packets = static_cast<unsigned>(answers.size());
        TraversalTask task = {to_ea(&prepared.frame()), to_ea(answers.data()), packets, 0, 0, bundles};
        machine->start(0, traversal_program(), to_ea(&task));
        machine->wait(0);
        REQUIRE(task.built == 1);
        for (unsigned i = 0; i < packets; ++i)
          check(round.asked[i], round.answers[i], answers[i]);
      }
  }
}

/// As they are for few objects, for many, and for more than that.
void check_hierarchies(PreparedScene& prepared, const Rounds& rounds) {
  const struct { bool large_leaves, far_nodes; } kinds[] = {{true, false}, {false, false}, {false, true}};
  for (const auto& kind : kinds) {
    INFO("large leaves: " << kind.large_leaves << ", far nodes: " << kind.far_nodes);
    prepared.use_bvh(kind.large_leaves, kind.far_nodes);
    check_accelerator(prepared, rounds);
  }
}

void check_scene(const Scene& scene, unsigned packets = times(160)) {
  PreparedScene prepared(scene);
  const Rounds rounds = rounds_of(prepared, queries_for(prepared, 99, packets));
  check_accelerator(prepared, rounds);
  check_hierarchies(prepared, rounds);
}

} // namespace

TEST_CASE("Through soups of spheres, ellipsoids, triangles and all of them") {
  check_scene(soup(1, {150, 0, 0}, 10, 1));
  check_scene(soup(2, {0, 150, 0}, 10, 1));
  check_scene(soup(3, {0, 0, 150}, 10, 2));
  check_scene(soup(4, {60, 60, 60}, 10, 3)); // much overlap
  check_scene(soup(5, {60, 60, 60}, 10, 0.1));
}

TEST_CASE("Through more objects than are at hand, so that leaves wait") {
  constexpr unsigned kTriangles = tuning::kObjectsInCoreCache + 1000;
  PreparedScene prepared(soup(9, {0, 0, kTriangles}, 10, 0.3));
  REQUIRE(prepared.object_count() > tuning::kObjectsInCoreCache);
  const std::vector<TraversalQuery> all = queries_for(prepared, 98, 32);
  // Some of them alone, some with much in common.
  constexpr int few = times(64) / 16 > 0 ? times(64) / 16 : 1;
  std::vector<TraversalQuery> some(all.begin(), all.begin() + few);
  some.insert(some.end(), all.end() - few, all.end());
  check_hierarchies(prepared, rounds_of(prepared, some));
}

TEST_CASE("Through large and small scenes, and far from the origin") {
  check_scene(soup(6, {50, 50, 50}, 1000, 100));
  check_scene(soup(7, {50, 50, 50}, 0.1, 0.02));
  Scene scene = soup(8, {50, 50, 50}, 10, 1);
  for (Object& object : scene.objects)
    object.transform = object.transform.then(Transform::translate({300, -200, 500}));
  check_scene(scene);
}

TEST_CASE("Through scenes without objects, and with one") {
  check_scene(soup(10, {0, 0, 0}, 1, 1), 20);
  check_scene(soup(11, {1, 0, 0}, 1, 1), 60);
  check_scene(soup(12, {0, 1, 0}, 1, 1), 60);
  check_scene(soup(13, {0, 0, 1}, 1, 1), 60);
}

TEST_CASE("Through objects that overlap") {
  Scene scene = soup(14, {100, 0, 100}, 5, 0.5);
  scene.objects.push_back(scene.objects.front());
  scene.objects.back().shape = Sphere{{0, 0, 0}, 30}; // fills everything
  check_scene(scene);
  check_scene(soup(15, {30, 30, 0}, 0.1, 5)); // all around the same point
}

TEST_CASE("Through a cluster in one voxel and a far outlier") {
  Scene scene = soup(16, {40, 40, 40}, 0.05, 0.02);
  scene.objects.push_back(scene.objects.front());
  scene.objects.back().shape = Sphere{{200, 100, -50}, 1};
  check_scene(scene);
}

TEST_CASE("Through flat scenes") {
  Random random(17);
  for (int axis = 0; axis < 3; ++axis) {
    Scene scene = soup(18, {0, 0, 200}, 10, 1);
    Mesh mesh = *std::get<std::shared_ptr<const Mesh>>(scene.objects[0].shape);
    for (Vec3f& vertex : mesh.vertices)
      vertex[axis] = 3;
    scene.objects[0].shape = std::make_shared<const Mesh>(mesh);
    check_scene(scene);
  }
}

TEST_CASE("Through slivers as long as the scene") {
  Scene scene = soup(19, {20, 0, 100}, 10, 0.05);
  const auto& object = scene.objects.back();
  Mesh mesh = *std::get<std::shared_ptr<const Mesh>>(object.shape);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3)
    mesh.vertices[i] = -mesh.vertices[i];
  scene.objects.back().shape = std::make_shared<const Mesh>(mesh);
  check_scene(scene);
}
