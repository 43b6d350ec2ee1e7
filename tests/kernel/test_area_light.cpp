// The sampling of lights that have an area: which places are looked at, what comes of them, and where they
// are.
#include "kernel/direct/area_occluders.hpp"
#include "kernel/direct/area_pairs.hpp"
#include "kernel/lights/area_shadow.hpp"
#include "kernel/lights/illumination.hpp"
#include "lanes.hpp"
#include "reference/area_light.hpp"
#include "scene_image/surface_records.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

using Place = std::pair<int, int>;

/// What comes from each place of a light to one lane.
using Grid = std::map<Place, Vec3>;

Light area_light(Random& random) {
  Light light;
  light.location = random.point(2) + Vec3(0, 6, 0);
  light.colour = {0.75, 0.5, 1};
  LightArea area;
  area.across = random.point(3);
  area.along = random.point(3);
  area.columns = 1 + static_cast<int>(random.below(12));
  area.rows = 1 + static_cast<int>(random.below(12));
  if (area.columns == 1) area.rows += 1; // a single place is none
  area.adaptive = static_cast<int>(random.below(5));
  area.circular = random.below(2) == 0;
  area.orient = random.below(3) == 0;
  light.area = area;
  return light;
}

/// Surfaces that face the light, and the sampling of it.
struct Sampling {
  DirectSpu spu;
  VectorLanes point, normal;
  WordLanes objects{};
  ShadowRays to_place;
  std::unique_ptr<AreaShadow<Simd>> shadow = std::make_unique<AreaShadow<Simd>>();
  std::unique_ptr<LightGrid> grid = std::make_unique<LightGrid>();
  LightRecord record;
  std::uint32_t facing = 0;

  Sampling(const Light& light, Random& random) : record(make_record(light)) {
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      set(point, l, random.point(2));
      set(normal, l, {0, 1, 0});
    }
  }
  /// Calls trace(shadow) for each place.
  template <class Trace> VectorLanes run(std::uint32_t lanes, Trace trace) {
    return sample(lanes, [&](const Surfaces<Simd>& surfaces, const IncidentLight<Simd>& incident,
                             VectorLanes& sum) {
      const std::uint32_t rays = sample_area(spu, record, surfaces, incident, to_place, *shadow, sum, trace);
      CHECK(rays == shadow->ray_count);
    });
  }
  /// The same of a light that is not tinted, in pairs. `lit_lanes(rays, lanes, distance)` returns those
  /// to which light comes.
  template <class LitLanes> VectorLanes run_in_pairs(std::uint32_t lanes, LitLanes lit_lanes) {
    const auto test = [&](RayQuery* queries, std::uint32_t count) {
      REQUIRE(count <= tuning::kMostAreaPackets);
      for (std::uint32_t i = 0; i < count; ++i)
        queries[i].lanes = lit_lanes(*queries[i].rays, queries[i].lanes, *queries[i].distance);
    };
    return sample(lanes,
                  [&](const Surfaces<Simd>& surfaces, const IncidentLight<Simd>& incident, VectorLanes& sum) {
                    begin_sampling(spu, record, surfaces, incident, to_place, *shadow);
                    AreaPairs<DirectSpu, false>(record, *grid, *shadow).sample(test);
                    module_areas::dim(spu, *shadow, sum);
                  });
  }
  /// The same where light may come tinted. `tint(rays, lane, distance)` is by what. Nothing if there is no
  /// room for what does.
  template <class Tint> std::optional<VectorLanes> run_tinted_in_pairs(std::uint32_t lanes, Tint tint) {
    const auto test = [&](RayQuery* queries, std::uint32_t count) {
      for (std::uint32_t i = 0; i < count; ++i)
        for_each_lane(queries[i].lanes, [&](unsigned l) {
          REQUIRE(test::at(*queries[i].light, l) == Vec3(1));
          set(*queries[i].light, l, tint(*queries[i].rays, l, *queries[i].distance));
        });
    };
    bool is_found = false;
    const VectorLanes sum = sample(
        lanes, [&](const Surfaces<Simd>& surfaces, const IncidentLight<Simd>& incident, VectorLanes& sent) {
          begin_sampling(spu, record, surfaces, incident, to_place, *shadow);
          is_found = AreaPairs<DirectSpu, true>(record, *grid, *shadow).sample(test);
          module_areas::dim(spu, *shadow, sent);
        });
    return is_found ? std::optional(sum) : std::nullopt;
  }

private:
  template <class Run> VectorLanes sample(std::uint32_t lanes, Run run) {
    const Surfaces<Simd> surfaces = {point.load<Simd>(), normal.load<Simd>(), {}, &objects};
    SceneAccess<DirectSpu> scene(spu, CacheConfig(), 0);
    IncidentLight<Simd> incident(record.colour);
    illuminate(scene, record, surfaces, lanes, incident);
    facing = incident.facing;
    VectorLanes sum; // of surfaces that send on all of it
    sum.store<Simd>(incident.colour);
    run(surfaces, incident, sum);
    return sum;
  }
};

} // namespace

TEST_CASE("A light with an area is the mean of its quads") {
  Random random(140);
  for (int k = 0; k < times(600); ++k) {
    const Light light = area_light(random);
    Sampling sampling(light, random);
    // A place is lit, dark or shines through glass; often its neighbours do the same.
    std::vector<Grid> grids(kSimdLanes);
    for (Grid& grid : grids) {
      const std::uint32_t kind = random.below(3);
      const double edge = random.uniform(0, 12);
      for (int row = 0; row < light.area->rows; ++row)
        for (int column = 0; column < light.area->columns; ++column) {
          const bool is_dark = kind == 0 ? random.below(2) == 0 : column + 0.4 * row < edge;
          const Vec3 through = kind == 1 ? Vec3(0.9, 0.3, 0.5) : Vec3(0);
          grid[{column, row}] = is_dark ? light.colour * through : light.colour;
        }
    }
    const std::uint32_t lanes = random.word() & 0xFFFF;
    const VectorLanes sum = sampling.run(lanes, [&](AreaShadow<Simd>& shadow) {
      REQUIRE((shadow.lanes & ~lanes) == 0);
      const Place place = {static_cast<int>(shadow.place.column), static_cast<int>(shadow.place.row)};
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        CHECK(test::at(shadow.light(), l) == Vec3(Vec3f(light.colour)));
        const Vec3 none(0);
        set(shadow.light(), l, (shadow.lanes >> l & 1) != 0 ? grids[l].at(place) : none);
      }
    });
    for_each_lane(sampling.facing, [&](unsigned l) {
      const Vec3 expected = reference::area_mean(*light.area, [&](int column, int row) {
        return grids[l].at({column, row});
      });
      REQUIRE(glm::length(test::at(sum, l) - expected) < 1e-5);
    });
  }
}

TEST_CASE("No place is looked at twice if all light comes from it, or none") {
  Random random(141);
  for (int k = 0; k < times(200); ++k) {
    Light light = area_light(random);
    light.area->adaptive = 100;
    Sampling sampling(light, random);
    std::map<Place, std::uint32_t> seen;
    sampling.run(0xFFFF, [&](AreaShadow<Simd>& shadow) {
      std::uint32_t& lanes = seen[{shadow.place.column, shadow.place.row}];
      REQUIRE((lanes & shadow.lanes) == 0);
      lanes |= shadow.lanes;
      if (shadow.place.column % 2 == 0) shadow.light() = VectorLanes{};
    });
    CHECK(seen.size() == std::size_t(light.area->columns * light.area->rows));
    for (const auto& [place, lanes] : seen)
      CHECK(lanes == sampling.facing);
  }
}

TEST_CASE("Where the places of a light are") {
  Random random(142);
  for (int k = 0; k < times(400); ++k) {
    Light light = area_light(random);
    light.parallel = random.below(4) == 0;
    light.point_at = light.location + Vec3(0.3, -1, 0.2);
    Sampling sampling(light, random);
    sampling.run(0xFFFF, [&](AreaShadow<Simd>& shadow) {
      for_each_lane(shadow.lanes, [&](unsigned l) {
        const Vec3 point = test::at(sampling.point, l);
        Vec3 middle = light.location - point;
        if (light.parallel) middle = light.location - light.point_at;
        const Vec3 toward = glm::normalize(middle);
        if (std::abs(std::abs(toward.z) - 0.99) < 1e-5) return;
        const Vec3 offset = reference::area_offset(*light.area, toward, static_cast<int>(shadow.place.column),
                                                   static_cast<int>(shadow.place.row));
        const Vec3 way = glm::normalize(middle + offset);
        double end = glm::length(middle + offset);
        if (light.parallel) end = std::max(glm::dot(light.location + offset - point, way), 0.0);
        REQUIRE(test::at(shadow.to_place->rays.origin, l) == point);
        REQUIRE(glm::length(test::at(shadow.to_place->rays.direction, l) - way) < 5e-6);
        REQUIRE(shadow.to_place->distance.lane[l] == Approx(end).margin(2e-5));
      });
    });
  }
}

TEST_CASE("Jitter is the same each time, other in each lane, and stays near the place") {
  Random random(143);
  Light light;
  light.location = {0, 6, 0};
  LightArea area;
  area.across = {4, 0, 0};
  area.along = {0, 0, 3};
  area.columns = 5;
  area.rows = 4;
  area.jitter = true;
  light.area = area;
  Sampling sampling(light, random);
  for (unsigned l = 0; l < kSimdLanes; ++l)
    set(sampling.point, l, {0, 0, 0});
  Vec3 sum(0), squares(0);
  std::map<Place, VectorLanes> first;
  int samples = 0;
  for (const bool again : {false, true}) {
    sampling.run(0xFFFF, [&](AreaShadow<Simd>& shadow) {
      const Place place = {static_cast<int>(shadow.place.column), static_cast<int>(shadow.place.row)};
      if (!again) first[place] = shadow.to_place->rays.direction;
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        CHECK(test::at(first[place], l) == test::at(shadow.to_place->rays.direction, l));
        const Vec3 ray =
            test::at(shadow.to_place->rays.direction, l) * double(shadow.to_place->distance.lane[l]);
        const Vec3 off = {ray.x - (place.first - 2.0), ray.y - 6, ray.z - (place.second - 1.5)};
        CHECK(std::abs(off.x) <= 0.500001);
        CHECK(std::abs(off.y) <= 1e-5);
        CHECK(std::abs(off.z) <= 0.500001);
        sum += off;
        squares += off * off;
        ++samples;
      }
    });
  }
  REQUIRE(samples == 2 * 20 * 16);
  CHECK(glm::length(sum) / samples < 0.03);
  CHECK(squares.x / samples == Approx(1.0 / 12).margin(0.01));
  CHECK(squares.z / samples == Approx(1.0 / 12).margin(0.01));
}

TEST_CASE("Places in pairs with surfaces leave the share that they leave one by one") {
  Random random(148);
  int divided = 0;
  for (int k = 0; k < times(400); ++k) {
    Light light = area_light(random);
    light.area->jitter = random.below(2) == 0;
    Sampling sampling(light, random);
    REQUIRE(AreaPairs<DirectSpu, false>::can_sample(sampling.record));
    for (unsigned l = 0; l < kSimdLanes; ++l)
      sampling.objects.lane[l] = 64 * l;
    // Stripes, which no two rays are in the same place of.
    const Vec3 axis = random.point(5);
    const auto lit_lanes = [&](const RayPacket& rays, std::uint32_t lanes, const FloatLanes& distance) {
      std::uint32_t lit = 0;
      for_each_lane(lanes, [&](unsigned l) {
        REQUIRE(test::at(rays.origin, l) == test::at(sampling.point, rays.start_object.lane[l] / 64));
        const double at = glm::dot(axis, test::at(rays.direction, l)) + distance.lane[l];
        lit |= static_cast<std::uint32_t>(at - std::floor(at) < 0.6) << l;
      });
      return lit;
    };
    const std::uint32_t lanes = random.word() & 0xFFFF;
    const VectorLanes expected = sampling.run(lanes, [&](AreaShadow<Simd>& shadow) {
      answer(shadow, lit_lanes(shadow.to_place->rays, shadow.lanes, shadow.to_place->distance));
    });
    const std::uint32_t rays = sampling.shadow->ray_count;
    const VectorLanes found = sampling.run_in_pairs(lanes, lit_lanes);
    CHECK(sampling.shadow->ray_count == rays);
    for_each_lane(sampling.facing, [&](unsigned l) { CHECK(test::at(found, l) == test::at(expected, l)); });
    divided += rays > 4 * kSimdLanes;
  }
  CHECK(divided > 100);
}

TEST_CASE("There is room for all quads of a grid that is looked at in pairs") {
  Random random(150);
  for (const Place& size : {Place{17, 17},
                            {41, 41},
                            {2, 256},
                            {3, 96},
                            {96, 3},
                            {1, 256},
                            {5, 57},
                            {16, 18},
                            {256, 6},
                            {7, 240},
                            {40, 42},
                            {33, 50}}) {
    Light light = area_light(random);
    light.area->columns = size.first;
    light.area->rows = size.second;
    light.area->adaptive = 100;
    light.area->circular = false;
    Sampling sampling(light, random);
    REQUIRE(AreaPairs<DirectSpu, false>::can_sample(sampling.record));
    const VectorLanes sum = sampling.run_in_pairs(
        0xFFFF, [](const RayPacket&, std::uint32_t lanes, const FloatLanes&) { return lanes; });
    CHECK(sampling.shadow->ray_count ==
          std::uint32_t(size.first * size.second * __builtin_popcount(sampling.facing)));
    for_each_lane(sampling.facing, [&](unsigned l) { CHECK(test::at(sum, l) == light.colour); });
  }
}

TEST_CASE("What comes tinted from places in pairs with surfaces is what does one by one") {
  Random random(149);
  int tinted = 0;
  for (int k = 0; k < times(400); ++k) {
    Light light = area_light(random);
    light.area->jitter = random.below(2) == 0;
    Sampling sampling(light, random);
    // Stripes of shadow, light and glass; for some surfaces glass alone.
    const Vec3 axis = random.point(3);
    const std::uint32_t clear = random.below(3);
    const auto tint = [&](const RayPacket& rays, unsigned l, const FloatLanes& distance) -> Vec3 {
      const double at = glm::dot(axis, test::at(rays.direction, l)) + distance.lane[l];
      const double part = at - std::floor(at);
      if (clear == 0 || part < 0.3) return {0.875, 0.25, 0.5};
      return part < 0.6 ? Vec3(0) : Vec3(1);
    };
    const std::uint32_t lanes = random.word() & 0xFFFF;
    const VectorLanes expected = sampling.run(lanes, [&](AreaShadow<Simd>& shadow) {
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        const bool asks = (shadow.lanes >> l & 1) != 0;
        set(shadow.light(), l,
            asks ? light.colour * tint(shadow.to_place->rays, l, shadow.to_place->distance) : Vec3(0));
      }
    });
    const std::uint32_t rays = sampling.shadow->ray_count;
    const std::optional<VectorLanes> found = sampling.run_tinted_in_pairs(lanes, tint);
    REQUIRE(found);
    // One by one what comes tinted is asked for again.
    CHECK(sampling.shadow->ray_count <= rays);
    for_each_lane(sampling.facing, [&](unsigned l) {
      REQUIRE(glm::length(test::at(*found, l) - test::at(expected, l)) < 1e-5);
    });
    tinted += __builtin_popcount(sampling.shadow->is_tinted);
  }
  CHECK(tinted > 500);
}

TEST_CASE("Places are not tested in pairs where there are too many, or light comes tinted from too many") {
  Random random(151);
  Light light = area_light(random);
  light.area->columns = light.area->rows = 41;
  light.area->adaptive = 100;
  const auto glass = [](const RayPacket&, unsigned, const FloatLanes&) { return Vec3(0.5); };
  Sampling large(light, random);
  CHECK_FALSE(large.run_tinted_in_pairs(0xFFFF, glass));
  CHECK(large.shadow->is_tinted == 0);
  light.area->columns = light.area->rows = 22;
  CHECK(Sampling(light, random).run_tinted_in_pairs(0xFFFF, glass));
  light.area->rows = 80;
  CHECK_FALSE(AreaPairs<DirectSpu, true>::can_sample(make_record(light)));
}

TEST_CASE("A shaft touches every node that is between surfaces and a place of the light") {
  Random random(147);
  int crossed = 0, touched = 0, all = 0;
  for (int k = 0; k < times(400); ++k) {
    Light light = area_light(random);
    light.area->adaptive = 100;
    light.area->jitter = random.below(2) == 0;
    Sampling sampling(light, random);
    alignas(16) float bounds[6][4];
    for (int child = 0; child < 4; ++child) {
      const Vec3 middle = random.point(4) + Vec3(0, 3, 0);
      for (int axis = 0; axis < 3; ++axis) {
        const double half = random.uniform(0.01, 0.6);
        bounds[2 * axis][child] = static_cast<float>(middle[axis] - half);
        bounds[2 * axis + 1][child] = static_cast<float>(middle[axis] + half);
      }
    }
    const std::uint32_t lanes = (random.word() & 0xFFFF) | 1;
    std::uint32_t between = 0, found = 0;
    bool is_known = false;
    sampling.run(lanes, [&](AreaShadow<Simd>& shadow) {
      if (!is_known) found = Shaft<Simd>(shadow.to_place->rays, lanes, sampling.record).intersect(bounds);
      is_known = true;
      for_each_lane(shadow.lanes, [&](unsigned l) {
        const Vec3 origin = test::at(shadow.to_place->rays.origin, l),
                   direction = test::at(shadow.to_place->rays.direction, l);
        for (int child = 0; child < 4; ++child) {
          double enter = 0, leave = shadow.to_place->distance.lane[l];
          for (int axis = 0; axis < 3; ++axis) {
            const double a = (bounds[2 * axis][child] - origin[axis]) / direction[axis];
            const double b = (bounds[2 * axis + 1][child] - origin[axis]) / direction[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
          }
          if (enter < leave) between |= 1u << child;
        }
      });
    });
    REQUIRE((between & ~found) == 0);
    if (!is_known) continue;
    all += 4;
    crossed += __builtin_popcount(between);
    touched += __builtin_popcount(found);
  }
  // Some nodes are crossed, and not all are touched.
  CHECK(crossed > all / 20);
  CHECK(touched < all / 2);
}
