// The elementary functions of math.hpp against those of double precision.
#include "kernel/math.hpp"
#include "lanes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace celltrace;
using namespace celltrace::test;
using namespace celltrace::kernel;

namespace {

/// The greatest error(x, f(x)) over 16 * `packets` values of `next`.
template <class Next, class Function, class Error>
double worst(int packets, Next next, Function function, Error error) {
  double most = 0;
  for (int k = 0; k < packets; ++k) {
    FloatLanes x;
    for (float& lane : x.lane)
      lane = static_cast<float>(next());
    const FloatLanes y = lanes_of(function(load(x)));
    for (unsigned l = 0; l < kSimdLanes; ++l)
      most = std::max(most, std::abs(error(x.lane[l], y.lane[l])));
  }
  return most;
}

double relative(double actual, double expected) {
  return expected == 0 ? actual : (actual - expected) / expected;
}

} // namespace

TEST_CASE("log2") {
  Random random(2);
  const auto function = [](const F& x) { return log2<Simd>(x); };
  CHECK(worst(
            20000, [&] { return random.uniform(0.5, 2); }, function,
            [](double x, double y) { return y - std::log2(x); }) < 2e-7);
  CHECK(worst(
            20000, [&] { return 1 + random.uniform(-1e-3, 1e-3); }, function,
            [](double x, double y) { return relative(y, std::log2(x)); }) < 2e-6);
  CHECK(worst(
            20000, [&] { return std::exp2(random.uniform(-126, 127)); }, function,
            [](double x, double y) { return (y - std::log2(x)) / std::max(1.0, std::abs(std::log2(x))); }) <
        2e-7);
  CHECK(worst(
            1, [] { return 1; }, function, [](double, double y) { return y; }) == 0);
}

TEST_CASE("exp2") {
  Random random(3);
  const auto function = [](const F& x) { return exp2<Simd>(x); };
  const auto error = [](double x, double y) { return relative(y, std::exp2(x)); };
  CHECK(worst(
            20000, [&] { return random.uniform(-1, 1); }, function, error) < 3e-7);
  CHECK(worst(
            20000, [&] { return random.uniform(-126, 126); }, function, error) < 3e-7);
  int n = -126;
  CHECK(worst(
            15, [&] { return n++; }, function, error) == 0);
  CHECK(worst(
            10, [&] { return -random.uniform(126, 1e6); }, function, [](double, double y) { return y; }) <=
        std::exp2(-126));
}

TEST_CASE("pow") {
  Random random(4);
  for (double power : {0.4, 0.45454545, 1.0, 2.2, 5.0, 40.0, 90.0, 500.0}) {
    INFO(power);
    // The error of the logarithm grows with the power.
    const double most = worst(
        5000, [&] { return random.uniform(0, 1); },
        [&](const F& x) { return kernel::pow<Simd>(x, F(static_cast<float>(power))); },
        [&](double x, double y) {
          const double expected = std::pow(x, power);
          const double bits = std::max(1.0, std::abs(power * std::log2(x)));
          return expected < 1e-37 ? std::min(1.0, y / 1e-37 / 4) * 1e-7 : relative(y, expected) / bits;
        });
    CHECK(most < 4e-7);
  }
  const auto zero = lanes_of(kernel::pow<Simd>(F(0.0f), F(3.0f)));
  CHECK(zero.lane[5] == 0);
  const auto one = lanes_of(kernel::pow<Simd>(F(1.0f), F(1e6f)));
  CHECK(one.lane[9] == 1);
}

TEST_CASE("whole_pow") {
  Random random(24);
  for (int power = 0; power < 8; ++power) {
    INFO(power);
    const auto whole = whole_power<Simd>(F(static_cast<float>(power) + 0.25f));
    CHECK(lanes_of(Simd::to_float(whole)).lane[3] == static_cast<float>(power));
    CHECK(worst(
              5000, [&] { return random.uniform(0, 2); },
              [&](const F& x) { return whole_pow<Simd>(x, whole); },
              [&](double x, double y) { return relative(y, std::pow(x, power)); }) < 4e-7);
  }
  for (const float beyond : {-1.0f, -1e30f, 7.5f, 1e30f})
    CHECK(lanes_of(Simd::to_float(whole_power<Simd>(F(beyond)))).lane[5] == (beyond < 0 ? 0.0f : 7.0f));
}

TEST_CASE("coarse_pow") {
  Random random(14);
  for (double power : {0.2, 0.4, 0.45454545, 1.0}) {
    INFO(power);
    const auto function = [&](const F& x) { return coarse_pow<Simd>(x, F(static_cast<float>(power))); };
    const auto error = [&](double x, double y) { return relative(y, std::pow(x, power)); };
    CHECK(worst(
              5000, [&] { return random.uniform(0, 1); }, function, error) < 1e-5);
    CHECK(worst(
              5000, [&] { return std::exp2(random.uniform(-60, 60)); }, function, error) < 1e-5);
  }
  const auto fifth = [](const F& x) { return coarse_pow<Simd>(x, F(5.0f)); };
  CHECK(worst(
            5000, [&] { return random.uniform(0.1, 10); }, fifth,
            [](double x, double y) { return relative(y, std::pow(x, 5)); }) < 5e-5);
  CHECK(std::isfinite(lanes_of(fifth(F(1e30f))).lane[7]));
  // Of 0 and of what is negative.
  for (float x : {0.0f, -1.0f, -1e30f}) {
    const auto least = lanes_of(coarse_pow<Simd>(F(x), F(0.4f)));
    CHECK(least.lane[3] >= 0);
    CHECK(least.lane[3] < 1e-14f);
  }
}

TEST_CASE("acos_unit") {
  Random random(5);
  const auto function = [](const F& x) { return acos_unit<Simd>(x); };
  const auto error = [](double x, double y) { return y - std::acos(x); };
  CHECK(worst(
            50000, [&] { return random.uniform(0, 1); }, function, error) < 2.5e-7);
  CHECK(worst(
            50000, [&] { return 1 - random.uniform(0, 1e-4); }, function, error) < 2.5e-7);
  CHECK(worst(
            1, [] { return 1; }, function, error) == 0);
}

TEST_CASE("sin_cos") {
  Random random(12);
  const auto sine = [](const F& x) {
    F s, c;
    sin_cos<Simd>(x, s, c);
    return s;
  };
  const auto cosine = [](const F& x) {
    F s, c;
    sin_cos<Simd>(x, s, c);
    return c;
  };
  const auto sine_error = [](double x, double y) { return y - std::sin(x); };
  const auto cosine_error = [](double x, double y) { return y - std::cos(x); };
  const auto small = [&] { return random.uniform(-100, 100); };
  CHECK(worst(50000, small, sine, sine_error) < 2e-7);
  CHECK(worst(50000, small, cosine, cosine_error) < 2e-7);
  const auto near_zero = [&] { return random.uniform(-1e-3, 1e-3); };
  CHECK(worst(1000, near_zero, sine, sine_error) < 1e-10);
  CHECK(worst(1000, near_zero, cosine, cosine_error) < 1e-7);
  const auto large = [&] { return random.uniform(-8000, 8000); };
  CHECK(worst(50000, large, sine, sine_error) < 5e-4);
  CHECK(worst(50000, large, cosine, cosine_error) < 5e-4);
  CHECK(worst(
            1, [] { return 0; }, cosine, cosine_error) == 0);
}

TEST_CASE("normalise") {
  Random random(6);
  for (int k = 0; k < 5000; ++k) {
    VectorLanes v;
    for (unsigned l = 0; l < kSimdLanes; ++l)
      set(v, l, random.direction() * std::pow(10.0, random.uniform(-12, 12)));
    const VectorLanes n = lanes_of(normalise<Simd>(v.load<Simd>()));
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      REQUIRE(glm::length(at(n, l)) == Approx(1).margin(3e-7));
      REQUIRE(glm::length(at(n, l) - glm::normalize(at(v, l))) < 3e-7);
    }
  }
  const VectorLanes zero = lanes_of(normalise<Simd>(Vec{F(0.0f), F(0.0f), F(0.0f)}));
  CHECK(at(zero, 7) == Vec3(0));
}

TEST_CASE("Vector operations") {
  Random random(7);
  for (int k = 0; k < 1000; ++k) {
    VectorLanes a, b;
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      set(a, l, random.point(3));
      set(b, l, random.point(3));
    }
    const Vec va = a.load<Simd>();
    const Vec vb = b.load<Simd>();
    const FloatLanes dots = lanes_of(dot<Simd>(va, vb));
    const VectorLanes crosses = lanes_of(cross<Simd>(va, vb));
    const FloatLanes greatest = lanes_of(max_component<Simd>(va));
    const FloatLanes luminance = lanes_of(grey<Simd>(va));
    const std::uint32_t mask = random.word() & 0xFFFF;
    const VectorLanes chosen = lanes_of(select<Simd>(M::from_bits(mask), va, vb));
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const Vec3 x = at(a, l);
      const Vec3 y = at(b, l);
      REQUIRE(std::abs(dots.lane[l] - glm::dot(x, y)) < 4e-6);
      REQUIRE(glm::length(at(crosses, l) - glm::cross(x, y)) < 6e-6);
      REQUIRE(greatest.lane[l] == std::max({x.x, x.y, x.z}));
      REQUIRE(std::abs(luminance.lane[l] - (0.297 * x.x + 0.589 * x.y + 0.114 * x.z)) < 1e-6);
      REQUIRE(at(chosen, l) == ((mask >> l & 1) != 0 ? x : y));
    }
  }
}
