// Maps, lists, normals, layers and the sky in single precision, against formulas in double precision.
#include "kernel/textures/normals.hpp"
#include "kernel/textures/sky.hpp"
#include "kernel/textures/transmittance.hpp"
#include "reference/shading.hpp"
#include "reference/textures.hpp"
#include "textures.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

constexpr std::uint32_t kAll = 0xFFFF;

/// Compares a pigment at sixteen points. Where a step of it is so near that rounding decides on which side a
/// point lies, it may be either. Returns how many points were clear of steps.
unsigned check_pigment(Textures& textures, const Pigment& pigment, const VectorLanes& points,
                       std::uint32_t lanes = kAll) {
  using Numbers = std::array<double, 5>;
  const auto numbers_at = [&](const Vec3& p) {
    const Pigment at = reference::pigment_at(pigment, {p});
    return Numbers{at.rgb.r, at.rgb.g, at.rgb.b, at.filter, at.transmit};
  };
  PigmentLanes<Simd> at;
  pigment_at(textures.access(), textures.material().pattern, {points.load<Simd>()}, lanes, at);
  const VectorLanes rgb = lanes_of(at.rgb);
  const FloatLanes filter = lanes_of(at.filter), transmit = lanes_of(at.transmit);
  unsigned clear = 0;
  for_each_lane(lanes, [&](unsigned l) {
    const Vec3 p = test::at(points, l);
    Numbers low = numbers_at(p), high = low;
    const double reach = 1e-5 * (1 + glm::length(p));
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 aside((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
      const Numbers there = numbers_at(p + reach * aside);
      for (std::size_t i = 0; i < 5; ++i) {
        low[i] = std::min(low[i], there[i]);
        high[i] = std::max(high[i], there[i]);
      }
    }
    const float found[5] = {rgb.x.lane[l], rgb.y.lane[l], rgb.z.lane[l], filter.lane[l], transmit.lane[l]};
    bool is_clear = true;
    for (std::size_t i = 0; i < 5; ++i) {
      REQUIRE(found[i] >= low[i] - 1e-4);
      REQUIRE(found[i] <= high[i] + 1e-4);
      is_clear = is_clear && high[i] - low[i] < 0.02;
    }
    clear += is_clear ? 1 : 0;
  });
  return clear;
}
unsigned check_pigment(const Pigment& pigment, const VectorLanes& points) {
  Textures textures(pigment);
  return check_pigment(textures, pigment, points);
}

Pigment any_colour(Random& random) {
  return {{random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)},
          random.below(2) * random.uniform(0, 1),
          random.below(2) * random.uniform(0, 1)};
}

bool is_list(const Pattern& pattern) {
  return std::holds_alternative<pattern::Checker>(pattern.kind) ||
         std::holds_alternative<pattern::Inside>(pattern.kind);
}

std::shared_ptr<const Object> any_object(Random& random) {
  const auto ball = [&] {
    Object object;
    object.shape = Sphere{random.point(1.5), random.uniform(0.5, 2)};
    object.inverse = random.below(3) == 0;
    return object;
  };
  if (random.below(2) == 0) return std::make_shared<const Object>(ball());
  Csg csg;
  csg.operation = static_cast<Csg::Operation>(random.below(4));
  Object box;
  box.shape = Box{{{-1, -0.7, -1.2}, {1.1, 0.8, 1}}};
  box.transform = Transform::rotate(random.point(180));
  csg.parts = {ball(), box, ball()};
  Object object;
  object.shape = std::make_shared<const Csg>(csg);
  object.transform = Transform::scale(Vec3(random.uniform(0.7, 2)));
  return std::make_shared<const Object>(object);
}

/// `blends`: if it is a list, waves may make blends of it.
Pattern any_pattern(Random& random, bool blends = false) {
  Pattern pattern;
  if (const unsigned which = random.below(5); which < 2)
    pattern.kind = pattern::Checker{};
  else if (which == 2)
    pattern.kind = pattern::Inside{any_object(random)};
  else
    pattern.kind = pattern::Gradient{random.direction() * random.uniform(0.5, 3)};
  if (random.below(2) == 0)
    pattern.space = {Transform::scale({random.uniform(0.5, 2), random.uniform(0.5, 2), 1})
                         .then(Transform::rotate(random.point(180)))
                         .then(Transform::translate(random.point(2)))};
  if (blends && is_list(pattern) && random.below(2) == 0) {
    pattern.wave = static_cast<Pattern::Wave>(random.below(6));
    pattern.wave_exponent = random.uniform(0.3, 3);
    pattern.frequency = random.below(4) == 0 ? random.below(2) : random.uniform(-2, 2);
    pattern.phase = random.uniform(-1, 1);
  }
  return pattern;
}

/// A tree of maps, no deeper than `depth`.
Pigment any_pigment(Random& random, unsigned depth) {
  if (depth == 0 || random.below(4) == 0) return any_colour(random);
  PatternMap<Pigment> map;
  map.pattern = any_pattern(random, depth == 1);
  map.is_average = random.below(4) == 0;
  if (depth > 1 && !map.is_average && random.below(4) == 0)
    map.pattern.kind = pattern::Grey{std::make_shared<const Pigment>(any_pigment(random, depth - 1))};
  const unsigned count = is_list(map.pattern) && !map.is_average ? 2 : 1 + random.below(5);
  double position = random.uniform(0, 0.4);
  for (unsigned i = 0; i < count; ++i) {
    map.entries.push_back({position + (map.is_average ? 0.1 : 0), any_pigment(random, depth - 1)});
    position += random.below(3) * 0.15;
  }
  Pigment pigment;
  pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
  return pigment;
}

} // namespace

TEST_CASE("A map before its first entry, between, at equal positions, and after the last") {
  Pattern pattern = gradient({1, 0, 0});
  pattern.frequency = 0;
  PatternMap<Pigment> map{pattern, {}};
  const double positions[] = {0.25, 0.5, 0.5, 0.5, 0.75};
  for (int i = 0; i < 5; ++i)
    map.entries.push_back({positions[i], Pigment{{0.1 + 0.2 * i, 1 - 0.2 * i, 0.5}, 0.1 * i, 0.2}});
  Pigment pigment;
  pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
  const double x[kSimdLanes] = {0,    0.1, 0.25, 0.3,   0.375, 0.5,   0.5001, 0.6,
                                0.75, 0.9, 1,    -0.75, -0.1,  -1.25, 0.625,  0.4999};
  check_pigment(pigment, points_of([&](unsigned l) { return Vec3(x[l], 0, 0); }));

  Textures textures(pigment);
  PigmentLanes<Simd> at;
  const auto red = [&](double value) {
    const VectorLanes points = points_of([&](unsigned) { return Vec3(value, 0, 0); });
    pigment_at(textures.access(), textures.material().pattern, {points.load<Simd>()}, kAll, at);
    return lanes_of(at.rgb).x.lane[5];
  };
  CHECK(red(0) == Approx(0.1));
  CHECK(red(0.25) == Approx(0.1));
  CHECK(red(0.5) == Approx(0.3));                     // the first of them
  CHECK(red(0.5 + 1e-6) == Approx(0.7).margin(1e-4)); // the last of them
  CHECK(red(0.625) == Approx(0.8));
  CHECK(red(1) == Approx(0.9));
  CHECK(red(-0.625) == Approx(0.2)); // begins again
}

TEST_CASE("A map whose last position comes twice has the very last entry there") {
  Pattern pattern = gradient({1, 0, 0});
  Pigment pigment;
  pigment.map = std::make_shared<const PatternMap<Pigment>>(PatternMap<Pigment>{
      pattern, {{0, Pigment{Vec3(0)}}, {0.5, Pigment{Vec3(0.25)}}, {0.5, Pigment{Vec3(1)}}}});
  Textures textures(pigment);
  PigmentLanes<Simd> at;
  const VectorLanes points = points_of([](unsigned l) { return Vec3(l % 2 == 0 ? 0.5 : 0.25, 0, 0); });
  pigment_at(textures.access(), textures.material().pattern, {points.load<Simd>()}, kAll, at);
  CHECK(lanes_of(at.rgb).x.lane[0] == 1);
  CHECK(lanes_of(at.rgb).x.lane[1] == Approx(0.125));
}

TEST_CASE("Trees of maps, lists and averages") {
  Random random(84);
  unsigned clear = 0, all = 0;
  for (int k = 0; k < times(800); ++k) {
    Pigment pigment;
    while (!pigment.map)
      pigment = any_pigment(random, 1 + static_cast<unsigned>(k) % kDeepestMap);
    Textures textures(pigment);
    const std::uint32_t lanes = k % 3 == 0 ? random.word() & kAll : kAll;
    for (const double reach : {2.0, 20.0}) {
      clear +=
          check_pigment(textures, pigment, points_of([&](unsigned) { return random.point(reach); }), lanes);
      for_each_lane(lanes, [&](unsigned) { ++all; });
    }
  }
  CHECK(clear > all - all / 20);
}

TEST_CASE("A walk through maps has lanes that were asked for, and weights that add up to 1") {
  Random random(91);
  for (int k = 0; k < 200; ++k) {
    Pigment pigment;
    while (!pigment.map)
      pigment = any_pigment(random, 3);
    Textures textures(pigment);
    const VectorLanes points = points_of([&](unsigned) { return random.point(5); });
    const std::uint32_t lanes = random.word() & kAll;
    const PatternPoints<Simd> asked = {points.load<Simd>()};
    MapWalk<DirectSpu, TextureStage::colours> walk(textures.access(), asked);
    walk.enter(textures.material().pattern, F(1.0f), lanes);
    F sum(0.0f), weight;
    MapEntryRecord leaf;
    std::uint32_t some;
    while (walk.next(leaf, weight, some)) {
      REQUIRE(some != 0);
      REQUIRE((some & ~lanes) == 0);
      REQUIRE(leaf.child == kNoOffset);
      sum = sum + weight;
    }
    const FloatLanes sums = lanes_of(sum);
    for_each_lane(lanes, [&](unsigned l) { REQUIRE(sums.lane[l] == Approx(1)); });
  }
}

TEST_CASE("A nested map moves with the map around it, its turbulence included") {
  // Of a gradient in a gradient whose turbulence is 0 along the inner direction: only steps count.
  PatternMap<Pigment> inner{gradient({0, 1, 0}), {{0, Pigment{Vec3(0)}}, {1, Pigment{Vec3(1)}}}};
  Pigment nested;
  nested.map = std::make_shared<const PatternMap<Pigment>>(inner);
  PatternMap<Pigment> outer{gradient({1, 0, 0}), {{0, nested}, {1, nested}}};
  outer.pattern.space = {Transform::translate({0, 0.25, 0})};
  outer.pattern.turbulence = {{0, 1, 0}, 1, 0.5, 2};
  Pigment pigment;
  pigment.map = std::make_shared<const PatternMap<Pigment>>(outer);
  Textures textures(pigment);
  const VectorLanes points = points_of([](unsigned l) { return kMeasured[l].point + Vec3(0, 0.25, 0); });
  PigmentLanes<Simd> at;
  pigment_at(textures.access(), textures.material().pattern, {points.load<Simd>()}, kAll, at);
  const VectorLanes rgb = lanes_of(at.rgb);
  for (unsigned l = 0; l < kSimdLanes; ++l) {
    if (glm::length(kMeasured[l].point) > 200) continue; // single precision has few digits left
    const double y = kMeasured[l].point.y + kMeasured[l].vector.y;
    const double value =
        reference::wave(inner.pattern, reference::number_of(pattern::Gradient{{0, 1, 0}}, {0, y, 0}));
    CHECK(rgb.x.lane[l] == Approx(value).margin(5e-5));
  }
}

TEST_CASE("Lists with waves blend what they list, maps and textures too") {
  Pattern half = gradient({1, 0, 0});
  half.kind = pattern::Checker{};
  half.frequency = 0.5;
  const Pigment ramp = Textures::grey(gradient({0, 1, 0}));
  const Pigment red{{1, 0, 0}};
  Pigment pigment;
  pigment.map = std::make_shared<const PatternMap<Pigment>>(PatternMap<Pigment>{half, {{0, red}, {1, ramp}}});
  Random random(99);
  const VectorLanes points = points_of([&](unsigned) { return random.point(3); });
  CHECK(check_pigment(pigment, points) > kSimdLanes / 2);

  Material map;
  map.map = std::make_shared<const PatternMap<Material>>(
      PatternMap<Material>{half, {{0, Textures::plain(red)}, {1, Textures::plain(ramp)}}});
  Textures textures(map);
  V3<Simd> filter;
  transmittance_at(textures.access(), textures.header().material_offset, {points.load<Simd>()}, kAll, filter);
  for (unsigned l = 0; l < kSimdLanes; ++l)
    CHECK(lanes_of(filter).x.lane[l] == Approx(0).margin(1e-6)); // opaque as both are

  Normal blunt;
  blunt.pattern.kind = pattern::Checker{};
  blunt.pattern.wave = Pattern::Wave::triangle; // 0 everywhere
  Material bumpy;
  bumpy.normal = std::make_shared<const Normal>(blunt);
  const VectorLanes units = points_of([&](unsigned) { return random.direction(); });
  Textures normals(bumpy);
  V3<Simd> unit = units.load<Simd>();
  disturb_normal(normals.access(), normals.material().normal, {points.load<Simd>()}, kAll, unit);
  for (unsigned l = 0; l < kSimdLanes; ++l)
    CHECK(glm::length(test::at(lanes_of(unit), l) - test::at(units, l)) < 1e-5);
}

TEST_CASE("Patterns inside patterns are as deep as maps may be") {
  Pigment pigment{{1, 1, 1}};
  for (int depth = 1; depth <= kDeepestMap; ++depth) {
    Pattern grey;
    grey.kind = pattern::Grey{std::make_shared<const Pigment>(pigment)};
    pigment = Textures::grey(grey);
    if (depth + 1 <= kDeepestMap) // what is one colour is a map, too
      CHECK_NOTHROW(Textures(pigment));
    else
      CHECK_THROWS_WITH(Textures(pigment), Catch::Contains("nest"));
  }
}

// --- normals ---

namespace {

/// As POV-Ray's, of a normal that is no map.
Vec3 disturbed(const Normal& normal, const Vec3& point, const Vec3& unit) {
  const Transform to_space = reference::to_own_space(normal.pattern);
  const Vec3 p = to_space.point(point);
  static const Vec3 corners[4] = {{0.942809041, -1 / 3.0, 0},
                                  {-0.471404521, -1 / 3.0, 0.816496581},
                                  {-0.471404521, -1 / 3.0, -0.816496581},
                                  {0, 1, 0}};
  Vec3 sum(0);
  for (const Vec3& corner : corners)
    sum += corner * reference::value_of(normal.pattern, {p + normal.accuracy * corner});
  const Vec3 local = glm::normalize(to_space.normal(unit));
  return glm::normalize(to_space.inverse().normal(local - sum * (0.1 * normal.amount / normal.accuracy)));
}

VectorLanes disturbed_by(const Normal& normal, const VectorLanes& points, const VectorLanes& units,
                         std::uint32_t lanes = kAll) {
  Material material;
  material.normal = std::make_shared<const Normal>(normal);
  Textures textures(material);
  Vec unit = units.load<Simd>();
  disturb_normal(textures.access(), textures.material().normal, {points.load<Simd>()}, lanes, unit);
  return lanes_of(unit);
}

/// Smooth everywhere.
Normal smooth_slope(Random& random) {
  Normal normal;
  normal.pattern = gradient(random.direction());
  normal.pattern.wave = Pattern::Wave::sine;
  if (random.below(2) == 0) {
    Pattern bright = normal.pattern;
    bright.space = {
        Transform::scale({random.uniform(0.5, 2), 1, 1}).then(Transform::rotate(random.point(180)))};
    normal.pattern = {};
    normal.pattern.kind = pattern::Grey{std::make_shared<const Pigment>(Textures::grey(bright))};
  }
  normal.amount = random.uniform(-2, 2);
  normal.accuracy = random.uniform(0.01, 0.05);
  return normal;
}

} // namespace

TEST_CASE("Normals by the slope of a pattern") {
  Random random(85);
  for (int k = 0; k < 300; ++k) {
    Normal normal = smooth_slope(random);
    if (k % 2 == 0)
      normal.pattern.space = {Transform::scale({random.uniform(0.3, 2), random.uniform(0.3, 2), -1.5})
                                  .then(Transform::rotate(random.point(180)))
                                  .then(Transform::translate(random.point(2)))};
    const VectorLanes points = points_of([&](unsigned) { return random.point(3); });
    const VectorLanes units = points_of([&](unsigned) { return random.direction(); });
    const std::uint32_t lanes = k % 3 == 0 ? random.word() & kAll : kAll;
    const VectorLanes found = disturbed_by(normal, points, units, lanes);
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const Vec3 before = test::at(units, l);
      const Vec3 expected = (lanes >> l & 1) != 0 ? disturbed(normal, test::at(points, l), before) : before;
      REQUIRE(glm::length(test::at(found, l) - expected) < 5e-4);
    }
  }
}

TEST_CASE("Bumps add noise in each coordinate") {
  Random random(86);
  const VectorLanes points = measured_points();
  const VectorLanes units = points_of([&](unsigned) { return random.direction(); });
  Normal normal;
  normal.pattern.kind = pattern::Bumps{};
  normal.pattern.wave = Pattern::Wave::sine; // means nothing to it
  normal.amount = 0.8;
  const VectorLanes found = disturbed_by(normal, points, units);
  for (unsigned l = 0; l < kSimdLanes; ++l)
    CHECK(glm::length(test::at(found, l) - glm::normalize(test::at(units, l) + 0.8 * kMeasured[l].vector)) <
          3e-6);
}

TEST_CASE("A map of normals blends them when they are of unit length") {
  Random random(87);
  for (int k = 0; k < 100; ++k) {
    const Normal first = smooth_slope(random), second = smooth_slope(random);
    PatternMap<Normal> map{gradient({0, 0, 1}), {{0, first}, {1, second}}};
    map.is_average = k % 2 == 0;
    if (map.is_average) map.entries[0].position = 3;
    Normal normal;
    normal.map = std::make_shared<const PatternMap<Normal>>(map);
    const VectorLanes points =
        points_of([&](unsigned) { return Vec3(random.uniform(-2, 2), 1, random.uniform(0.01, 0.99)); });
    const VectorLanes units = points_of([&](unsigned) { return random.direction(); });
    const VectorLanes found = disturbed_by(normal, points, units);
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const Vec3 p = test::at(points, l);
      const double share = map.is_average ? 0.25 : p.z;
      const Vec3 expected = glm::normalize((1 - share) * disturbed(first, p, test::at(units, l)) +
                                           share * disturbed(second, p, test::at(units, l)));
      REQUIRE(glm::length(test::at(found, l) - expected) < 2e-3);
    }
  }
}

// --- layers, texture maps and the sky ---

namespace {

std::shared_ptr<const Material> layers_of(const std::vector<Pigment>& pigments) {
  std::shared_ptr<const Material> below;
  for (const Pigment& pigment : pigments)
    below = std::make_shared<const Material>(Material{pigment, {}, nullptr, below});
  return below;
}

/// A gradient along z between two colours, which lies from 0 to 1 without a step.
Pigment blend_along_z(Random& random) {
  Pigment pigment;
  pigment.map = std::make_shared<const PatternMap<Pigment>>(
      PatternMap<Pigment>{gradient({0, 0, 1}), {{0, any_colour(random)}, {1, any_colour(random)}}});
  return pigment;
}

} // namespace

TEST_CASE("Layers let through the product, maps of textures the blend") {
  Random random(88);
  for (int k = 0; k < 200; ++k) {
    std::vector<Pigment> pigments[2];
    for (auto& list : pigments)
      for (unsigned i = random.below(4); i < 4; ++i)
        list.push_back(random.below(2) == 0 ? any_colour(random) : blend_along_z(random));
    const auto first = layers_of(pigments[0]), second = layers_of(pigments[1]);
    Material mapped;
    mapped.map = std::make_shared<const PatternMap<Material>>(
        PatternMap<Material>{gradient({1, 0, 0}), {{0, *first}, {1, *second}}});
    const VectorLanes points =
        points_of([&](unsigned) { return Vec3(random.uniform(0.01, 0.99), 2, random.uniform(0.01, 0.99)); });
    const auto transmitted = [&](const Material& material) {
      Textures textures(material);
      Vec through;
      transmittance_at(textures.access(), textures.header().material_offset, {points.load<Simd>()}, kAll,
                       through);
      return lanes_of(through);
    };
    const VectorLanes by_layers = transmitted(*first), by_map = transmitted(mapped);
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const Vec3 p = test::at(points, l);
      Vec3 product[2] = {Vec3(1), Vec3(1)};
      for (int i = 0; i < 2; ++i)
        for (const Pigment& pigment : pigments[i])
          product[i] *= reference::filter_colour(reference::pigment_at(pigment, {p}));
      REQUIRE(glm::length(test::at(by_layers, l) - product[0]) < 1e-5);
      REQUIRE(glm::length(test::at(by_map, l) - (product[0] * (1 - p.x) + product[1] * p.x)) < 1e-5);
    }
  }
}

TEST_CASE("Two layers of sky over a background are POV-Ray's, before and from version 3.7") {
  // Measured to 16 bits.
  const std::pair<double, Vec3> versions[] = {{3.6, {0.450599, 0.547906, 0.548196}},
                                              {3.7, {0.415122, 0.592981, 0.60737}}};
  for (const auto& [version, expected] : versions) {
    INFO(version);
    Scene scene;
    scene.version = version;
    scene.background = {0.3, 0.5, 0.9};
    scene.sky_sphere = {Pigment{{0.8, 0.4, 0.6}, 0.3, 0.25}, Pigment{{0.5, 0.9, 0.7}, 0.35, 0.2}};
    Textures textures(scene);
    const VectorLanes up = points_of([](unsigned) { return Vec3(0, 1, 0); });
    VectorLanes colours = points_of([&](unsigned) { return scene.background; });
    Vec colour = colours.load<Simd>();
    add_sky(textures.access(), textures.header().sky, up.load<Simd>(), kAll, colour);
    colours = lanes_of(colour);
    for (unsigned l = 0; l < kSimdLanes; ++l)
      CHECK(glm::length(test::at(colours, l) - expected) < 3e-5);
  }
}

TEST_CASE("The sky is a pattern of directions") {
  Random random(89);
  Scene scene;
  scene.background = {0.9, 0.1, 0.4};
  scene.sky_sphere = {Textures::grey(gradient({0, 0, 1}))};
  Textures textures(scene);
  const VectorLanes directions = points_of([&](unsigned) {
    const Vec3 d = random.direction();
    return Vec3(d.x, d.y, std::abs(d.z));
  });
  Vec colour = points_of([&](unsigned) { return scene.background; }).load<Simd>();
  add_sky(textures.access(), textures.header().sky, directions.load<Simd>(), kAll, colour);
  const VectorLanes colours = lanes_of(colour);
  for (unsigned l = 0; l < kSimdLanes; ++l)
    CHECK(glm::length(test::at(colours, l) - Vec3(directions.z.lane[l])) < 1e-5);
}
