// Patterns, waves, maps, normals, layers and the sky in single precision, against formulas in double
// precision and numbers that POV-Ray 3.7 has for them.
#include "celltrace/texture.hpp"
#include "kernel/textures/normals.hpp"
#include "kernel/textures/sky.hpp"
#include "kernel/textures/transmittance.hpp"
#include "lanes.hpp"
#include "reference/shading.hpp"
#include "reference/textures.hpp"
#include "scene/scene_image.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <set>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

constexpr std::uint32_t kAll = 0xFFFF;

/// A scene of textures only, as the kernel reads it.
class Textures {
public:
  explicit Textures(const Scene& scene) : image_(scene) {}
  explicit Textures(const Material& material) : Textures(scene_of(material)) {}
  explicit Textures(const Pigment& pigment) : Textures(plain(pigment)) {}
  explicit Textures(const Pattern& pattern) : Textures(grey(pattern)) {}

  const ImageHeader& header() const { return image_.header(); }
  SceneAccess<DirectSpu>& access() { return access_; }
  const MaterialRecord& material() { return *access_.material(header().material_offset); }
  /// Of the first material's pigment.
  const PatternRecord& pattern() { return *access_.pattern(material().pattern); }

  static Material plain(const Pigment& pigment) {
    Material material;
    material.pigment = pigment;
    return material;
  }
  static Pigment grey(const Pattern& pattern) {
    Pigment pigment;
    pigment.map = std::make_shared<const PatternMap<Pigment>>(
        PatternMap<Pigment>{pattern, {{0, Pigment{Vec3(0)}}, {1, Pigment{Vec3(1)}}}});
    return pigment;
  }

private:
  static Scene scene_of(const Material& material) {
    Scene scene;
    scene.materials = {material};
    return scene;
  }

  SceneImage image_;
  DirectSpu spu_;
  SceneAccess<DirectSpu> access_{spu_, CacheConfig(), reinterpret_cast<std::uintptr_t>(image_.base())};
};

VectorLanes points_of(const std::function<Vec3(unsigned)>& point) {
  VectorLanes points;
  for (unsigned l = 0; l < kSimdLanes; ++l)
    set(points, l, point(l));
  return points;
}

/// Values of a pattern at points of its own space, wave included.
FloatLanes values(const Pattern& pattern, const VectorLanes& points) {
  Textures textures(pattern);
  return lanes_of(pattern_value(textures.access(), PatternRecord(textures.pattern()), {points.load<Simd>()}));
}

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

/// What POV-Ray 3.7 has at a point: f_noise_generator 1 and 2, vturbulence(2, 0.5, 1, p) and
/// vturbulence(2.3, 0.7, 4, p), to nine decimals.
struct Measured {
  Vec3 point;
  double first, second;
  Vec3 vector, turbulence;
};
constexpr Measured kMeasured[kSimdLanes] = {
    {{0, 0, 0},
     0.0565805,
     0.298322439,
     {-0.4434195, 0.3610055, -0.459716},
     {-1.123181573, 0.914426915, -1.164460607}},
    {{0.5, 0.25, 0.75},
     0.229814691,
     0.383182216,
     {-0.270185309, -0.497926325, 0.332525255},
     {-0.272718763, -0.470404662, 0.567349635}},
    {{-0.5, -0.25, -0.75},
     0.604671367,
     0.56680794,
     {0.104671367, 0.089640339, -0.007910775},
     {0.771303719, -0.104499934, -0.182046826}},
    {{1.5, 2.5, 3.5},
     0.445319369,
     0.488748437,
     {-0.054680631, -0.004251437, 0.002180225},
     {0.028943051, -0.107113659, 0.021987546}},
    {{-3.25, 7.125, -1.875},
     0.288130172,
     0.411748394,
     {-0.211869828, 0.081637729, 0.052170216},
     {0.023806304, 0.414513503, -0.101258253}},
    {{0.125, 0, 0.875},
     0.41641019,
     0.474587107,
     {-0.08358981, -0.492647391, 0.172313766},
     {-0.106584216, -0.420008271, -0.029334629}},
    {{10.75, -20.375, 30.625},
     0.700087697,
     0.613548185,
     {0.200087697, 0.151176178, -0.311092083},
     {0.355930272, -0.116774602, -0.702680042}},
    {{-100.5, 50.25, -75.125},
     0.485405081,
     0.508384656,
     {-0.014594919, 0.205454652, -0.753889803},
     {-0.013827369, -0.29766214, -1.071709326}},
    {{999.5, -1000.25, 500.75},
     0.216256937,
     0.376540871,
     {-0.283743063, -0.125647252, -0.025769624},
     {-0.119389657, -0.34955151, -0.22837273}},
    {{4095.5, 4096.25, 4097.75},
     0.657352412,
     0.592614057,
     {0.157352412, 0.309392428, -0.19856589},
     {0.217547045, 0.327431188, 0.009924635}},
    {{-4097.5, -4095.25, -8191.75},
     0,
     0.167466242,
     {-0.710551566, 0.003113872, 0.185752223},
     {-0.636550346, 0.342486042, 0.493707688}},
    {{2, 3, 4}, 0.3084, 0.421677687, {-0.1916, 0.1391545, 0.219539}, {0.00637353, 0.140989718, 0.56568207}},
    {{-2, -3, -4},
     0.2314185,
     0.383967851,
     {-0.2685815, 0.2499655, 0.2224995},
     {-0.561687274, 0.025015247, 0.134204789}},
    {{0.9375, -0.0625, 0.5},
     0.059433484,
     0.29971999,
     {-0.440566516, -0.60716104, 0.279824825},
     {-0.483067819, -0.681248959, 0.160574524}},
    {{12345.5, -23456.25, 34567.75},
     0,
     0.214094586,
     {-0.615363673, -0.159040229, 0.214713506},
     {-0.645534229, -0.234935871, 0.47922753}},
    {{3.625, -4.375, 5.0625},
     0.749586527,
     0.637795475,
     {0.249586527, -0.412988479, -0.148927661},
     {0.164990307, -0.213151041, -0.465783186}},
};
VectorLanes measured_points() {
  return points_of([](unsigned l) { return kMeasured[l].point; });
}

Pattern gradient(const Vec3& direction) {
  Pattern pattern;
  pattern.kind = pattern::Gradient{direction};
  return pattern;
}
Pattern noise_of_generator(int generator) {
  Pattern pattern;
  pattern.kind = pattern::Bozo{};
  pattern.noise_generator = generator;
  return pattern;
}

} // namespace

TEST_CASE("Checker") {
  Pattern pattern;
  pattern.kind = pattern::Checker{};
  Random random(80);
  for (const double reach : {2.0, 50.0, 5000.0})
    for (int k = 0; k < 100; ++k) {
      const VectorLanes points = points_of([&](unsigned) { return random.point(reach); });
      const FloatLanes found = values(pattern, points);
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        const Vec3 p = test::at(points, l);
        const auto is_near = [&](double x) { return std::abs(x - std::round(x)) < 2e-5 + 2e-6 * reach; };
        if (!is_near(p.x) && !is_near(p.y) && !is_near(p.z))
          REQUIRE(found.lane[l] == reference::number_of(pattern::Checker{}, p));
      }
    }
}

TEST_CASE("Checker at whole numbers, and where rounding has moved them") {
  Pattern pattern;
  pattern.kind = pattern::Checker{};
  Random random(81);
  for (const double off : {0.0, 3e-6, -3e-6})
    for (int k = 0; k < 100; ++k) {
      Vec3 whole[kSimdLanes];
      const VectorLanes points = points_of([&](unsigned l) {
        const Vec3 p = random.point(8);
        whole[l] = {std::floor(p.x), std::floor(p.y), std::floor(p.z)};
        return whole[l] + Vec3(off);
      });
      const FloatLanes found = values(pattern, points);
      for (unsigned l = 0; l < kSimdLanes; ++l)
        REQUIRE(found.lane[l] == reference::number_of(pattern::Checker{}, whole[l]));
    }
}

TEST_CASE("Bricks where mortar begins, and where rounding has moved that") {
  Pattern pattern;
  pattern.kind = pattern::Brick{};
  const pattern::Brick brick;
  Random random(85);
  for (const double off : {0.0, 1e-5, -1e-5})
    for (int k = 0; k < 100; ++k) {
      Vec3 edge[kSimdLanes];
      const VectorLanes points = points_of([&](unsigned l) {
        const auto course = std::floor(random.uniform(-4, 4)), column = std::floor(random.uniform(-4, 4));
        const bool is_odd = std::fmod(std::abs(course), 2) == 1;
        edge[l] = {(column + (is_odd ? 0.5 : 0)) * brick.size.x + brick.size.x - brick.mortar,
                   (course + 0.3) * brick.size.y,
                   (std::floor(random.uniform(-4, 4)) + (is_odd ? 0.8 : 0.3)) * brick.size.z};
        return edge[l] + Vec3(off, 0, 0);
      });
      const FloatLanes found = values(pattern, points);
      const FloatLanes before =
          values(pattern, points_of([&](unsigned l) { return edge[l] - Vec3(0.01, 0, 0); }));
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        REQUIRE(found.lane[l] == 0);
        REQUIRE(before.lane[l] == 1);
      }
    }
}

TEST_CASE("Gradient") {
  Random random(82);
  for (const double reach : {1.5, 100.0})
    for (int k = 0; k < 200; ++k) {
      const Vec3 direction = random.direction() * random.uniform(0.1, 9);
      Pattern pattern = gradient(direction);
      pattern.frequency = 0; // the number itself, or what it is above a whole one if it is less than 0
      const VectorLanes points = points_of([&](unsigned) { return random.point(reach); });
      const FloatLanes found = values(pattern, points);
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        double expected = reference::number_of(pattern::Gradient{direction}, test::at(points, l));
        if (expected < 0) expected -= std::floor(expected);
        if (std::abs(expected - std::round(expected)) > 1e-4)
          REQUIRE(found.lane[l] == Approx(expected).margin(2e-7 * (1 + 2 * reach)));
      }
    }
}

TEST_CASE("A gradient is 1 at 1, and begins again after it and below 0") {
  Pattern pattern = gradient({1, 0, 0});
  pattern.frequency = 0;
  const double x[kSimdLanes] = {0,  0.5,  1,     1.5, 2,  2.25,     1000.75,  -0.25,
                                -1, -1.5, -1000, 3,   -7, 1 + 2e-6, 1 - 2e-6, 0.999};
  const double expected[kSimdLanes] = {0, 0.5, 1, 0.5, 0, 0.25, 0.75, 0.75, 0, 0.5, 0, 0, 0, 1, 1, 0.999};
  const FloatLanes found = values(pattern, points_of([&](unsigned l) { return Vec3(x[l], 9, -9); }));
  for (unsigned l = 0; l < kSimdLanes; ++l)
    CHECK(found.lane[l] == Approx(expected[l]).margin(1e-7));
}

TEST_CASE("Patterns without noise or parameters, at random points") {
  const pattern::Kind kinds[] = {pattern::Onion{}};
  Random random(90);
  for (const pattern::Kind& kind : kinds) {
    INFO("kind " << kind.index());
    for (const double reach : {1.0, 100.0})
      for (int k = 0; k < 200; ++k) {
        Pattern pattern;
        pattern.kind = kind;
        pattern.frequency = 0; // the number itself
        const VectorLanes points = points_of([&](unsigned) { return random.point(reach); });
        const FloatLanes found = values(pattern, points);
        for (unsigned l = 0; l < kSimdLanes; ++l) {
          const double expected = reference::number_of(kind, test::at(points, l));
          // Not at a step: what is closer snaps to it.
          if (std::abs(expected - std::round(expected)) > 1e-5 + 4e-6 * reach)
            REQUIRE(found.lane[l] == Approx(expected).margin(2e-7 * (1 + 2 * reach)));
        }
      }
  }
}

TEST_CASE("Random points, waves, generator 3 and fractals are POV-Ray's") {
  constexpr double kPoints[kSimdLanes][3] = {
      {0.5, 0.25, 0.75},          {-0.5, -0.25, -0.75},     {1.5, 2.5, 3.5},
      {-3.25, 7.125, -1.875},     {0.125, 0.0625, 0.875},   {10.75, -20.375, 30.625},
      {-7.625, -8.375, -9.125},   {100.25, 200.5, -300.75}, {0.8125, 0.9375, -0.3125},
      {2.71875, -1.625, 0.34375}, {-12.5, 3.375, 6.28125},  {5.0625, 5.5625, 5.9375},
      {-0.84375, 0.21875, 0},     {-0.1875, 0.6875, 0.25},  {0.28125, 0.53125, -1},
      {1.25, -0.40625, 0.5}};
  // pattern { ... } in functions of POV-Ray 3.7, to nine decimals.
  const struct {
    pattern::Kind kind;
    int generator;
    double expected[kSimdLanes];
  } rows[] = {
      {pattern::Crackle{},
       2,
       {0.207111882, 0.164112532, 0.392818144, 0.006110207, 0.158647776, 0.001067735, 0.152966148,
        0.553912099, 0.243305623, 0.17811773, 0.537725763, 0.239974543, 0.218968492, 0.307006389, 0.382333945,
        0.316120685}},
      {pattern::Crackle{{1, 0, 0}},
       2,
       {0.484385911, 0.51810641, 0.534549664, 0.784004166, 0.486015779, 0.574229237, 0.475433111, 0.269594682,
        0.012831933, 0.604474553, 0.199627174, 0.614190477, 0.391118538, 0.632683798, 0.579086185,
        0.385397157}},
      {pattern::Crackle{{-1, 0.5, 0.3}, 1},
       2,
       {0.140569097, 0.081199156, 0.211348457, 0, 0.296360677, 0.05774099, 0.309511396, 0.528946799,
        0.568978486, 0.062465001, 0.505037829, 0.171411108, 0.164080643, 0.051360046, 0.3711104,
        0.334047483}},
      {pattern::Crackle{{1, 0, 0}, 3, 0.2},
       2,
       {0.439655966, 0.476585525, 0.501918406, 0.674847974, 0.493827954, 0.522993457, 0.483052521,
        0.270917004, 0.200014337, 0.517617924, 0.246414174, 0.583698974, 0.383591344, 0.581286195,
        0.537682903, 0.376343543}},
      {pattern::Crackle{{-1, 1, 0}, 2, 0, true},
       2,
       {0.432515687, 0.608818231, 0.556078485, 0.297810453, 0.434939973, 0.611974558, 0.630244168,
        0.643677145, 0.432821227, 0.684037297, 0.38135631, 0.634785101, 0.470553391, 0.4577364, 0.569750993,
        0.330950139}},
      {pattern::Cells{},
       2,
       {0.711818915, 0.206389704, 0.030540943, 0.394707474, 0.711818915, 0.376101934, 0.264779026,
        0.422645652, 0.824241705, 0.43027784, 0.310812341, 0.62105452, 0.566954876, 0.566954876, 0.824241705,
        0.071445459}},
      {pattern::Ripples{},
       2,
       {0.31575318, 0.374581813, 0.565742441, 0.423180165, 0.109265317, 0.58598062, 0.384738569, 0.593308277,
        0.397666961, 0.4114586, 0.540974526, 0.613092028, 0.361372693, 0.30609994, 0.481013576, 0.627259429}},
      {pattern::Waves{},
       2,
       {0.645523559, 0.709418695, 0.482891021, 0.636630374, 0.659294948, 0.378563867, 0.549087215,
        0.601995685, 0.450307879, 0.332603177, 0.464401171, 0.676984419, 0.693636473, 0.697510853,
        0.650164141, 0.646263371}},
      {pattern::Bozo{},
       3,
       {0.606314746, 0.422155109, 0.421843673, 0.346398116, 0.611163138, 0.621386858, 0.538465719, 0.3816739,
        0.288706614, 0.488296546, 0.522274426, 0.73704373, 0.598765372, 0.422334233, 0.56831693,
        0.537235675}},
      {pattern::Granite{},
       3,
       {0.086225477, 0.053433886, 0.080987871, 0.228008825, 0.35133618, 0.30350785, 0.041013759, 0.052853399,
        0.271414465, 0.444117235, 0.230344131, 0.263780025, 0.308704208, 0.294086151, 0.5259275,
        0.080055719}},
      {pattern::Fractal{false, {0, 0}, 10}, 2, {0.3, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 0}},
  };
  const VectorLanes points =
      points_of([&](unsigned l) { return Vec3(kPoints[l][0], kPoints[l][1], kPoints[l][2]); });
  for (const auto& row : rows) {
    INFO("kind " << row.kind.index());
    Pattern pattern;
    pattern.kind = row.kind;
    pattern.noise_generator = row.generator;
    const FloatLanes found = values(pattern, points);
    for (unsigned l = 0; l < kSimdLanes; ++l)
      CHECK(found.lane[l] ==
            Approx(row.expected[l]).margin(3e-4)); // granite has steps of 0.004 at 128 times 300
  }
}

TEST_CASE("Noise is POV-Ray's") {
  const VectorLanes points = measured_points();
  const FloatLanes first = values(noise_of_generator(1), points),
                   second = values(noise_of_generator(2), points);
  Pattern bumps = noise_of_generator(2);
  bumps.kind = pattern::Bumps{};
  const FloatLanes of_bumps = values(bumps, points);
  const VectorLanes vector = lanes_of(noise::vector<Simd>(points.load<Simd>()));
  for (unsigned l = 0; l < kSimdLanes; ++l) {
    INFO("lane " << l);
    CHECK(first.lane[l] == Approx(kMeasured[l].first).margin(4e-7));
    CHECK(second.lane[l] == Approx(kMeasured[l].second).margin(4e-7));
    CHECK(of_bumps.lane[l] == second.lane[l]);
    CHECK(glm::length(test::at(vector, l) - kMeasured[l].vector) < 8e-7);
  }
}

TEST_CASE("The scene's noise generator is that of patterns without one") {
  const VectorLanes points = measured_points();
  for (const int generator : {1, 2}) {
    Scene scene;
    scene.noise_generator = generator;
    scene.materials = {Textures::plain(Textures::grey(noise_of_generator(0)))};
    Textures textures(scene);
    const FloatLanes found =
        lanes_of(pattern_value(textures.access(), PatternRecord(textures.pattern()), {points.load<Simd>()}));
    const FloatLanes expected = values(noise_of_generator(generator), points);
    for (unsigned l = 0; l < kSimdLanes; ++l)
      CHECK(found.lane[l] == expected.lane[l]);
  }
}

TEST_CASE("Turbulence displaces points as POV-Ray's") {
  const VectorLanes points = measured_points();
  const Turbulence turbulence{{1, -2, 0.5}, 4, 0.7, 2.3};
  Pattern own = gradient({1, 0, 0});
  own.turbulence = turbulence;
  Pattern warped = own;
  warped.turbulence = {};
  warped.space = {Transform::scale({2, 4, 8}), turbulence, Transform::translate({1, 2, 3})};
  const auto in_space_of = [](const Pattern& pattern, const VectorLanes& from) {
    Textures textures(pattern);
    return lanes_of(to_pattern_space<TextureStage::colours>(
                        textures.access(), PatternRecord(textures.pattern()), {from.load<Simd>()}, 0xFFFF)
                        .at);
  };
  const VectorLanes displaced = in_space_of(own, points);
  const VectorLanes stepped =
      in_space_of(warped, points_of([](unsigned l) { return kMeasured[l].point + Vec3(1, 2, 3); }));
  for (unsigned l = 0; l < kSimdLanes; ++l) {
    INFO("lane " << l);
    const Vec3 p = kMeasured[l].point;
    const Vec3 expected = p + turbulence.amount * kMeasured[l].turbulence;
    // The finest octave is at 12 times the coordinates.
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const double margin = 2e-6 * (1 + 4 * largest);
    CHECK(glm::length(test::at(displaced, l) - expected) < margin);
    CHECK(glm::length(test::at(stepped, l) - expected / Vec3(2, 4, 8)) < margin);
  }
}

TEST_CASE("Waves") {
  using Wave = Pattern::Wave;
  Random random(83);
  for (const Wave wave : {Wave::ramp, Wave::triangle, Wave::sine, Wave::scallop, Wave::cubic, Wave::poly})
    for (int k = 0; k < 200; ++k) {
      INFO("wave " << static_cast<int>(wave));
      Pattern pattern = gradient({1, 0, 0});
      pattern.wave = wave;
      pattern.wave_exponent = random.uniform(0.3, 4);
      pattern.frequency = random.below(4) == 0 ? 1 : random.uniform(-3, 5);
      pattern.phase = random.below(2) * random.uniform(-2, 2);
      const VectorLanes points = points_of([&](unsigned) { return random.point(3); });
      const FloatLanes found = values(pattern, points);
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        const double x = reference::number_of(pattern::Gradient{{1, 0, 0}}, test::at(points, l));
        const double turns = x * pattern.frequency + pattern.phase;
        const double near = std::abs(turns - std::round(turns));
        if (near < 2e-4) continue; // a step, or a steep root
        REQUIRE(found.lane[l] == Approx(reference::wave(pattern, x)).margin(3e-5));
      }
    }
}

TEST_CASE("Waves at the ends of their period") {
  using Wave = Pattern::Wave;
  const std::pair<Wave, double> at_one[] = {{Wave::ramp, 1},    {Wave::triangle, 0}, {Wave::sine, 0.5},
                                            {Wave::scallop, 0}, {Wave::cubic, 1},    {Wave::poly, 1}};
  for (const auto& [wave, expected] : at_one) {
    INFO("wave " << static_cast<int>(wave));
    Pattern pattern = gradient({1, 0, 0});
    pattern.wave = wave;
    pattern.wave_exponent = 3;
    const FloatLanes found = values(pattern, points_of([](unsigned l) { return Vec3(l % 2, 0, 0); }));
    CHECK(found.lane[1] == Approx(expected).margin(1e-6));
    CHECK(found.lane[0] == Approx(wave == Wave::sine ? 0.5 : 0).margin(1e-6));
  }
}

TEST_CASE("Frequency 0 leaves the number, whatever its phase, for its wave") {
  using Wave = Pattern::Wave;
  Pattern pattern = gradient({0, 1, 0});
  pattern.frequency = 0;
  pattern.phase = 0.3;
  for (const Wave wave : {Wave::ramp, Wave::sine, Wave::triangle, Wave::poly}) {
    pattern.wave = wave;
    pattern.wave_exponent = 2;
    const FloatLanes found = values(pattern, points_of([](unsigned l) { return Vec3(0, 0.06 * l, 0); }));
    for (unsigned l = 0; l < kSimdLanes; ++l)
      CHECK(found.lane[l] == Approx(reference::wave(pattern, 0.06 * l)).margin(1e-6));
  }
}

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

TEST_CASE("Fractals that are iterated together have the values of points by themselves") {
  constexpr unsigned kPackets = 8;
  using Fractals = FractalValues<Simd, kPackets>;
  Random random(74);
  const pattern::Fractal of_all[] = {
      {false, {0, 0}, 3000}, {false, {0, 0}, 333}, {true, {-0.745, 0.11}, 1000}};
  for (const pattern::Fractal& fractal : of_all) {
    Pattern pattern;
    pattern.kind = fractal;
    Textures textures(pattern), others(pattern);
    const PatternRecord &record = textures.pattern(), &other = others.pattern();
    REQUIRE(Fractals::takes(record));
    const auto fractals = std::make_unique<Fractals>();
    CHECK_FALSE(fractals->begin());
    Complex<Simd> at[kPackets];
    std::uint32_t lanes[kPackets];
    for (unsigned i = 0; i < kPackets; ++i) {
      // Near the edge, where points stay for long, and all around it.
      const Vec3 centre = i == 0 || fractal.is_julia ? Vec3(0) : Vec3(-0.745, 0.11, 0);
      const double reach = i == 0 ? 2 : fractal.is_julia ? 0.3 : 0.01;
      const VectorLanes points = points_of([&](unsigned) { return centre + random.point(reach); });
      at[i] = {points.load<Simd>().x, points.load<Simd>().y};
      lanes[i] = (random.word() & 0xFFFF) | 0xFF;
      fractals->add(i, record, lanes[i], at[i]);
      fractals->add(i, record, lanes[i], {at[i].b, at[i].a}); // each has its point
      fractals->add(i, other, 0xFFFF, at[i]);                 // as they all have their pattern
    }
    fractals->run();
    std::set<float> different;
    for (unsigned i = 0; i < kPackets; ++i) {
      const Simd::F expected =
          FractalPattern::value<DirectSpu>(textures.access(), {at[i].a, at[i].b, at[i].b}, record);
      fractals->show(i);
      Simd::F value(-1.0f);
      CHECK(fractals->find(other, at[i], value).bits() == 0);
      CHECK(fractals->find(record, {at[i].a + Simd::F(1.0f), at[i].b}, value).bits() == 0);
      CHECK(fractals->find(record, at[i], value).bits() == lanes[i]);
      const FloatLanes found = lanes_of(value), alone = lanes_of(expected);
      for (unsigned lane = 0; lane < kSimdLanes; ++lane) {
        const bool is_known = (lanes[i] >> lane & 1) != 0;
        REQUIRE(found.lane[lane] == (is_known ? alone.lane[lane] : -1.0f));
        different.insert(found.lane[lane]);
      }
    }
    CHECK(different.size() > 10);
    CHECK(fractals->begin()); // the next ones will take long, too
    CHECK_FALSE(fractals->begin());
    fractals->run();
  }
}

TEST_CASE("Fractals are iterated together if rounds are counted") {
  const auto takes = [](const pattern::Fractal& fractal) {
    Pattern pattern;
    pattern.kind = fractal;
    return FractalValues<Simd, 1>::takes(Textures(pattern).pattern());
  };
  pattern::Fractal fractal;
  fractal.iterations = 100;
  CHECK(takes(fractal));
  fractal.interior = 1;
  CHECK_FALSE(takes(fractal));
  fractal.interior = 0;
  fractal.exponent = 3;
  CHECK_FALSE(takes(fractal));
  fractal = {};
  fractal.iterations = 10;
  CHECK_FALSE(takes(fractal));
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
