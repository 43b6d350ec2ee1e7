// What light sources send to surfaces, in single precision, against the formulas of the reference.
#include "kernel/lights/illumination.hpp"
#include "lanes.hpp"
#include "reference/shading.hpp"
#include "scene_image/surface_records.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// Sixteen surfaces in a cube that lights may be in, too.
struct Places {
  VectorLanes point, normal;

  explicit Places(Random& random) {
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      set(point, l, random.point(4));
      set(normal, l, random.direction());
    }
  }
  Surfaces<Simd> surfaces() const { return {point.load<Simd>(), normal.load<Simd>(), {}, nullptr}; }
};

/// As it comes out of the kernel.
struct Incident {
  VectorLanes direction, colour;
  FloatLanes distance, cosine;
  std::uint32_t facing;

  Incident(const Light& light, const Places& places, std::uint32_t lanes) {
    DirectSpu spu;
    SceneAccess<DirectSpu> scene(spu, CacheConfig(), 0);
    const LightRecord record = make_record(light);
    IncidentLight<Simd> in(record.colour);
    illuminate(scene, record, places.surfaces(), lanes, in);
    direction = lanes_of(in.direction);
    colour = lanes_of(in.colour);
    distance = lanes_of(in.distance);
    cosine = lanes_of(in.cosine);
    facing = in.facing;
  }
};

Light any_light(Random& random, Light::Kind kind) {
  Light light;
  light.kind = kind;
  light.location = random.point(4);
  light.point_at = light.location + random.direction() * random.uniform(0.5, 6);
  light.colour = {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
  const bool cone = kind == Light::Kind::spotlight;
  light.radius = random.uniform(0, cone ? 100 : 3);
  light.falloff = light.radius + random.uniform(cone ? 3 : 0.2, cone ? 60 : 4);
  light.tightness = random.below(2) * random.uniform(0, 10);
  light.parallel = kind == Light::Kind::point && random.below(2) == 0;
  light.fade_distance = random.below(2) * random.uniform(0.5, 8);
  if (random.below(4) == 0) light.fade_distance = -light.fade_distance;
  light.fade_power = random.below(4) * 0.75;
  return light;
}

/// Compares all lanes; returns how many have light.
unsigned check(const Light& light, const Places& places, std::uint32_t lanes) {
  const Incident in(light, places, lanes);
  unsigned lit = 0;
  for_each_lane(lanes, [&](unsigned l) {
    const reference::Incoming expected = reference::incoming(light, test::at(places.point, l));
    const double cosine = glm::dot(expected.to_light, test::at(places.normal, l));
    const double brightest = std::max({expected.colour.r, expected.colour.g, expected.colour.b});
    const bool faces = (in.facing >> l & 1) != 0;
    lit += faces ? 1 : 0;
    if (cosine < -1e-5 || brightest == 0) REQUIRE_FALSE(faces);
    if (cosine > 1e-5 && brightest > 1e-4) REQUIRE(faces);
    if (!faces) return;
    REQUIRE(glm::length(test::at(in.direction, l) - expected.to_light) < 2e-6);
    REQUIRE(in.distance.lane[l] == Approx(std::max(expected.distance, 0.0)).margin(4e-6));
    REQUIRE(in.cosine.lane[l] == Approx(cosine).margin(2e-6));
    REQUIRE(glm::length(test::at(in.colour, l) - expected.colour) < 2e-4);
  });
  REQUIRE((in.facing & ~lanes) == 0);
  return lit;
}

} // namespace

TEST_CASE("The light of every kind of source") {
  for (const Light::Kind kind : {Light::Kind::point, Light::Kind::spotlight, Light::Kind::cylinder}) {
    INFO("kind " << static_cast<int>(kind));
    Random random(70);
    unsigned lit = 0;
    for (int k = 0; k < times(4000); ++k) {
      const Light light = any_light(random, kind);
      const Places places(random);
      lit += check(light, places, k % 3 == 0 ? random.word() & 0xFFFF : 0xFFFF);
    }
    CHECK(lit > unsigned(times(4000)));
  }
}

TEST_CASE("A light of a point is what it was without other kinds") {
  Random random(71);
  for (int k = 0; k < 200; ++k) {
    Light light;
    light.location = random.point(4);
    const LightRecord record = make_record(light);
    CHECK(is_plain(record));
    light.shadowless = true;
    CHECK(is_plain(make_record(light)));
    check(light, Places(random), 0xFFFF);
  }
}

TEST_CASE("Light along a surface does not come to it") {
  Random random(5);
  Places places(random);
  Light light;
  light.location = {0, 0, -40};
  for (unsigned l = 0; l < kSimdLanes; ++l) {
    const float rounded = (l % 2 == 0 ? -1.0f : 1.0f) * static_cast<float>(l) * 1e-8f;
    set(places.point, l, {rounded, random.uniform(0, 1), random.uniform(0, 1)});
    set(places.normal, l, {1, 0, 0});
  }
  CHECK(Incident(light, places, 0xFFFF).facing == 0);
  light.location.x = 0.01;
  CHECK(Incident(light, places, 0xFFFF).facing == 0xFFFF);
}

TEST_CASE("Behind parallel light distances are negative, and odd powers of them") {
  Light light;
  light.location = {0, -20, 0};
  light.point_at = {1, -25, 0}; // all places are behind it
  light.parallel = true;
  light.fade_distance = 60;
  Random random(74);
  Places places(random);
  for (unsigned l = 0; l < kSimdLanes; ++l)
    set(places.normal, l, {0, 1, 0});
  for (const double power : {1.0, 2.0, 3.0, 4.0}) {
    light.fade_power = power;
    CHECK(check(light, places, 0xFFFF) == kSimdLanes);
  }
  const float before = Incident(light, places, 0xFFFF).colour.x.lane[0];
  CHECK(before < 2);
  light.fade_power = 3;
  CHECK(Incident(light, places, 0xFFFF).colour.x.lane[0] > 2);
  light.fade_power = 2.5;
  CHECK(check(light, places, 0xFFFF) == 0);
}

TEST_CASE("A narrow beam far away has a smooth edge") {
  Light light;
  light.kind = Light::Kind::spotlight;
  light.location = {0, 1000, 0};
  light.point_at = {0, 0, 0};
  light.radius = 0.1;
  light.falloff = 0.2;
  Random random(72);
  Places places(random);
  for (unsigned l = 0; l < kSimdLanes; ++l) {
    set(places.point, l, {0.25 * l, 0, 0});
    set(places.normal, l, {0, 1, 0});
  }
  const Incident in(light, places, 0xFFFF);
  for (unsigned l = 0; l < kSimdLanes; ++l)
    CHECK(in.colour.x.lane[l] ==
          Approx(reference::incoming(light, test::at(places.point, l)).colour.x).margin(1e-3));
  CHECK(in.facing == 0x3FFF); // the beam ends at 3.49
}

TEST_CASE("Beams as POV-Ray has them at their limits") {
  Random random(73);
  const Places places(random);
  const auto lanes_lit = [&](const Light& light) {
    check(light, places, 0xFFFF);
    return Incident(light, places, 0xFFFF).facing;
  };
  Light light;
  light.location = {0, 5, 0};
  light.point_at = {0, 0, 0};
  const std::uint32_t all = lanes_lit(light);

  light.kind = Light::Kind::spotlight;
  light.radius = 30;
  light.falloff = 20; // ends before it begins: a step at 30
  lanes_lit(light);
  light.falloff = 30;
  lanes_lit(light);
  light.radius = 120; // a half space
  light.falloff = 150;
  lanes_lit(light);

  light.kind = Light::Kind::cylinder;
  light.falloff = 0;
  CHECK(lanes_lit(light) == 0);
  light.falloff = 2;
  light.radius = 0; // no edge
  lanes_lit(light);
  light.radius = 3;
  lanes_lit(light);

  light.point_at = light.location; // no axis, no light
  light.kind = Light::Kind::spotlight;
  CHECK(Incident(light, places, 0xFFFF).colour.x.lane[0] == 0);
  light.kind = Light::Kind::point;
  CHECK(lanes_lit(light) == all);
}

TEST_CASE("A parallel spotlight is a parallel light") {
  Random random(74);
  for (int k = 0; k < 100; ++k) {
    Light light = any_light(random, Light::Kind::spotlight);
    light.parallel = true;
    const Places places(random);
    const Incident in(light, places, 0xFFFF);
    light.kind = Light::Kind::point;
    const Incident parallel(light, places, 0xFFFF);
    CHECK(in.facing == parallel.facing);
    for (unsigned l = 0; l < kSimdLanes; ++l)
      CHECK(test::at(in.colour, l) == test::at(parallel.colour, l));
  }
}
