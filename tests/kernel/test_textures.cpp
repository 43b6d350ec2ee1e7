// Patterns, noise and waves in single precision, against formulas in double precision and numbers that
// POV-Ray 3.7 has for them.
#include "reference/textures.hpp"
#include "textures.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// Values of a pattern at points of its own space, wave included.
FloatLanes values(const Pattern& pattern, const VectorLanes& points) {
  Textures textures(pattern);
  return lanes_of(pattern_value(textures.access(), PatternRecord(textures.pattern()), {points.load<Simd>()}));
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

TEST_CASE("Points on the edge of a brick are mortar, even if rounding has moved them") {
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

TEST_CASE("Crackle has the same values where lanes are in one cell and where each is in another") {
  const pattern::Crackle kinds[] = {{},
                                    {{1, 0, 0}},
                                    {{-1, 0.5, 0.3}},
                                    {{0, 1, 0}, 1},
                                    {{1, -1, 1}, 1},
                                    {{1, 0, 0}, 3},
                                    {{-1, 1, 0}, 2, 0, true}};
  Random random(95);
  for (const pattern::Crackle& kind : kinds) {
    INFO("form " << kind.form[0] << ' ' << kind.form[1] << ' ' << kind.form[2] << " metric " << kind.metric);
    Pattern pattern;
    pattern.kind = kind;
    for (const double reach : {1.5, 40.0})
      for (int k = 0; k < 25; ++k) {
        const VectorLanes points = points_of([&](unsigned) { return random.point(reach); });
        const FloatLanes found = values(pattern, points);
        for (unsigned l = 0; l < kSimdLanes; ++l) {
          const FloatLanes alone = values(pattern, points_of([&](unsigned) { return test::at(points, l); }));
          REQUIRE(found.lane[l] == alone.lane[l]);
        }
      }
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
