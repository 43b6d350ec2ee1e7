// Bundles of primary rays that leave one point: what they are bounded by, and what is found by that.
#include "compiled_once.hpp"
#include "kernel/direct/pinhole_bundle.hpp"
#include "made_records.hpp"
#include "prepared_scene.hpp"
#include "soups.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

constexpr std::uint32_t kEdge = 4, kPackets = kEdge * kEdge;

void set(float (&record)[3], const Vec3& value) {
  for (int i = 0; i < 3; ++i)
    record[i] = static_cast<float>(value[i]);
}

/// A camera at `eye` that looks in the direction of `aim`, through a picture of `width` x `height` pixels.
void point_camera(FrameBlock& frame, Random& random, const Vec3& eye, const Vec3& aim) {
  frame.width = 16 + random.below(200);
  frame.height = 16 + random.below(200);
  frame.packet_columns = (frame.width + 3) / 4;
  frame.packet_rows = (frame.height + 3) / 4;
  frame.camera.kind = kCameraKind<PerspectiveCamera>;
  const Vec3 forward = glm::normalize(aim);
  const double wide = std::pow(10.0, random.uniform(-3, 0.5));
  const Vec3 right = glm::normalize(glm::cross(forward, random.direction())) * wide;
  const Vec3 up = glm::normalize(glm::cross(right, forward)) * wide;
  set(frame.camera.origin, eye);
  const double scale = std::pow(10.0, random.uniform(-3, 3));
  set(frame.camera.base, forward * scale);
  frame.camera.middle_x = 0.5f * static_cast<float>(frame.width) - 0.5f;
  frame.camera.middle_y = 0.5f * static_cast<float>(frame.height) - 0.5f;
  set(frame.camera.dx, right * (scale / frame.width));
  set(frame.camera.dy, -up * (scale / frame.height));
}

struct Place {
  std::uint32_t column, row; ///< of a bundle
};
Place any_bundle(const FrameBlock& frame, Random& random) {
  return {random.below((frame.packet_columns + kEdge - 1) / kEdge),
          random.below((frame.packet_rows + kEdge - 1) / kEdge)};
}

/// The packets of a bundle as a tracer queries for their hits.
struct Bundle {
  RayPacket rays[kPackets];
  HitPacket hits[kPackets];
  RayQuery queries[kPackets];

  Bundle(const FrameBlock& frame, const Place& place) {
    for (std::uint32_t i = 0; i < kPackets; ++i) {
      const std::uint32_t column = place.column * kEdge + i % kEdge, row = place.row * kEdge + i / kEdge;
      const bool inside = column < frame.packet_columns && row < frame.packet_rows;
      DirectSpu spu;
      if (inside) make_primary_rays(spu, frame, column, row, rays[i]);
      queries[i] = {&rays[i], &hits[i], nullptr, nullptr, inside ? lanes_in_picture(frame, column, row) : 0};
    }
  }
};

} // namespace

TEST_CASE("The beams of a pinhole bundle meet every box that one of its rays meets") {
  Random random(110);
  auto frame = std::make_unique<FrameBlock>();
  int bundles = 0;
  for (int k = 0; k < times(3000); ++k) {
    point_camera(*frame, random, random.point(k % 3 == 0 ? 1000 : 1), random.direction());
    const Place place = any_bundle(*frame, random);
    const PinholeBundle<Simd> pinhole(*frame, place.column, place.row);
    if (pinhole.packets == 0) continue;
    ++bundles;
    const Bundle bundle(*frame, place);
    BundleFrusta<Simd, kPackets> beams;
    beams.set(pinhole.bounds, pinhole.octant);
    Frustum<Simd> around;
    around.set(pinhole.all, pinhole.octant);
    const FloatLanes shortening = lanes_of(pinhole.shortening);
    const SlabOrder sides(pinhole.octant);
    for (int trial = 0; trial < 40; ++trial) {
      const std::uint32_t packet = random.below(kPackets), lane = random.below(kSimdLanes);
      if ((bundle.queries[packet].lanes >> lane & 1) == 0) continue;
      const RayPacket& rays = bundle.rays[packet];
      REQUIRE(octant_of(rays, lane) == pinhole.octant);
      const double distance = std::pow(10.0, random.uniform(-2, 4));
      const Vec3 point = at(rays.origin, lane) + at(rays.direction, lane) * distance;
      // Not less than the coordinates' own rounding.
      const double half =
          (1e-5 + std::pow(10.0, random.uniform(-5, 0))) * glm::length(glm::abs(point) + distance);
      const Vec3 middle = point + random.point(0.9 * half);
      alignas(16) float box[6][4];
      put_box(box, middle - half, middle + half);
      alignas(64) float limits[kPackets];
      for (std::uint32_t i = 0; i < kPackets; ++i)
        limits[i] = static_cast<float>(distance * 1.00001) * shortening.lane[i];
      const int child = static_cast<int>(random.below(4));
      REQUIRE((beams.intersect(box, sides, static_cast<std::uint32_t>(child), limits) >> packet & 1) == 1);
      alignas(16) float enter[4];
      REQUIRE(around.intersect(box, sides, limits[packet], enter) == 0xF);
      REQUIRE(enter[child] <= limits[packet]);
    }
  }
  CHECK(bundles > times(3000) / 2);
}

TEST_CASE("A bundle of primary rays hits what its packets hit, and nothing where it is lost") {
  Random random(111);
  int lost = 0, found = 0;
  for (const Scene& scene :
       {soup(30, {0, 0, 400}, 10, 1), soup(31, {60, 60, 60}, 10, 1), soup(32, {0, 0, 30}, 10, 4)}) {
    for (const bool large_leaves : {false, true}) {
      PreparedScene prepared(scene);
      prepared.use_bvh(large_leaves, !large_leaves);
      REQUIRE(prepared.prepare().built);
      FrameBlock& frame = prepared.frame();
      for (int k = 0; k < times(300); ++k) {
        const Vec3 eye = random.point(k % 4 == 0 ? 8 : 60);
        point_camera(frame, random, eye, k % 2 == 0 ? random.point(12) - eye : random.direction());
        DirectSpu spu;
        SceneAccess<DirectSpu> access(spu, CacheConfig(), frame.image);
        Traversal<DirectSpu> traversal(access, frame);
        const Place place = any_bundle(frame, random);
        const PinholeBundle<Simd> pinhole(frame, place.column, place.row);
        Bundle together(frame, place), alone(frame, place);
        const bool is_lost = !traversal.enter(pinhole);
        traversal.intersect_from_pinhole(together.queries, pinhole);
        for (RayQuery& query : alone.queries)
          if (query.lanes != 0) traversal.find_closest(*query.rays, query.lanes, *query.hits);
        lost += is_lost;
        for (std::uint32_t i = 0; i < kPackets; ++i)
          for_each_lane(alone.queries[i].lanes, [&](std::uint32_t lane) {
            const std::uint32_t object = alone.hits[i].object.lane[lane];
            REQUIRE(together.hits[i].object.lane[lane] == object);
            if (object == kNoOffset) return;
            REQUIRE_FALSE(is_lost);
            REQUIRE(together.hits[i].distance.lane[lane] == alone.hits[i].distance.lane[lane]);
            const auto kind = reinterpret_cast<const ObjectRecord*>(frame.image + object)->kind_and_flags &
                              object_flag::kind_mask;
            if (static_cast<ObjectKind>(kind) == ObjectKind::triangle) {
              REQUIRE(together.hits[i].u.lane[lane] == alone.hits[i].u.lane[lane]);
              REQUIRE(together.hits[i].v.lane[lane] == alone.hits[i].v.lane[lane]);
            }
            ++found;
          });
      }
    }
  }
  CHECK(lost > 10);
  CHECK(found > 1000);
}
