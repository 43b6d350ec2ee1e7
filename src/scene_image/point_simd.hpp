// A SIMD facade (celltrace/spe/simd.hpp) of one lane in double precision, with which the kernel's code of
// patterns runs for single points on the host, as exactly as POV-Ray's.
#pragma once

#include "celltrace/spe/spu.hpp"
#include "kernel/angles.hpp"
#include "kernel/direct/memory.hpp"
#include "kernel/local/patterns.hpp"
#include "kernel/math.hpp"
#include "kernel/textures/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace celltrace {

/// A facade for rare code (Spu::rare_simd).
struct PointSimd {
  static constexpr std::uint32_t kLanes = 1;

  struct M {
    bool holds;

    static M none() { return {false}; }
    static M all() { return {true}; }
    static M from_bits(std::uint32_t bits) { return {(bits & 1) != 0}; }
    std::uint32_t bits() const { return holds ? 1 : 0; }
    friend M operator&(M a, M b) { return {a.holds && b.holds}; }
    friend M operator|(M a, M b) { return {a.holds || b.holds}; }
    friend M operator!(M a) { return {!a.holds}; }
  };

  struct F {
    double value;

    F() = default;
    F(double number) : value(number) {}
    static F load(const float* numbers) { return {*numbers}; }
    void store(float* numbers) const { *numbers = static_cast<float>(value); }
    friend F operator+(F a, F b) { return {a.value + b.value}; }
    friend F operator-(F a, F b) { return {a.value - b.value}; }
    friend F operator*(F a, F b) { return {a.value * b.value}; }
    friend F operator/(F a, F b) { return {a.value / b.value}; }
    friend F operator-(F a) { return {-a.value}; }
    friend M operator<(F a, F b) { return {a.value < b.value}; }
    friend M operator<=(F a, F b) { return {a.value <= b.value}; }
    friend M operator>(F a, F b) { return {a.value > b.value}; }
    friend M operator>=(F a, F b) { return {a.value >= b.value}; }
    friend M operator==(F a, F b) { return {a.value == b.value}; }
  };

  struct I {
    std::int32_t value;

    static I splat(std::int32_t number) { return {number}; }
    static I load(const std::int32_t* numbers) { return {*numbers}; }
    void store(std::int32_t* numbers) const { *numbers = value; }
    friend I operator+(I a, I b) { return wrapped(std::int64_t{a.value} + b.value); }
    friend I operator-(I a, I b) { return wrapped(std::int64_t{a.value} - b.value); }
    friend I operator&(I a, I b) { return {a.value & b.value}; }
    friend I operator|(I a, I b) { return {a.value | b.value}; }
    friend I operator^(I a, I b) { return {a.value ^ b.value}; }
    friend M operator==(I a, I b) { return {a.value == b.value}; }
    friend M operator<(I a, I b) { return {a.value < b.value}; }

  private:
    static I wrapped(std::int64_t number) { return {static_cast<std::int32_t>(number)}; }
  };

  struct U4; ///< type of cache tags, which is not defined: direct memory has no caches

  static F min(F a, F b) { return {std::min(a.value, b.value)}; }
  static F max(F a, F b) { return {std::max(a.value, b.value)}; }
  static F abs(F a) { return {std::fabs(a.value)}; }
  static F sqrt(F a) { return {std::sqrt(a.value)}; }
  static F floor(F a) { return {std::floor(a.value)}; }
  template <class T> static T select(M m, T a, T b) { return m.holds ? a : b; }
  static F to_float(I a) { return {static_cast<double>(a.value)}; }
  /// Converts to an integer; values out of range become the nearest bound, NaN becomes 0.
  static I to_int(F a) {
    constexpr double kMost = 2147483647.0;
    return {std::isnan(a.value) ? 0 : static_cast<std::int32_t>(std::clamp(a.value, -kMost, kMost))};
  }

  template <std::uint32_t kRows, std::uint32_t kChannels, class StartsOf, class FactorsOf>
  static void sum_rows(const float* table, const StartsOf& starts_of, const FactorsOf& factors_of,
                       F (&sums)[kChannels]) {
    std::uint32_t starts[kRows];
    starts_of(0, starts);
    for (F& sum : sums)
      sum = F(0.0);
    for (std::uint32_t row = 0; row < kRows; ++row) {
      F factors[4];
      factors_of(row, factors);
      for (std::uint32_t channel = 0; channel < kChannels; ++channel)
        for (std::uint32_t i = 0; i < 4; ++i)
          sums[channel] = sums[channel] + F(table[starts[row] + 4 * channel + i]) * factors[i];
    }
  }
};

/// Evaluates patterns at one point at a time. No SPE uses it.
class PointSpu : public SpuBase<PointSpu> {
public:
  static constexpr bool direct_memory = true;
  using simd = PointSimd;
  using rare_simd = PointSimd;
};

namespace kernel {

/// The traits by which patterns find records. Shortcuts that look at many lanes are of no use to one lane.
struct PointStrategy : DirectMemory, LocalPatterns {};
template <> struct StrategyOf<PointSpu> { using Type = PointStrategy; };

// Elementary functions in full double precision.
template <> inline PointSimd::F log2<PointSimd>(const PointSimd::F& x) {
  return {std::log2(x.value)};
}
template <> inline PointSimd::F exp2<PointSimd>(const PointSimd::F& x) {
  return {std::exp2(x.value)};
}
template <> inline PointSimd::F pow<PointSimd>(const PointSimd::F& x, const PointSimd::F& y) {
  return {x.value > 0 ? std::pow(x.value, y.value) : 0};
}
template <> inline PointSimd::F coarse_pow<PointSimd>(const PointSimd::F& x, const PointSimd::F& y) {
  return pow<PointSimd>(x, y);
}
template <> inline PointSimd::F sine_of_turns<PointSimd>(const PointSimd::F& turns) {
  return {std::sin(turns.value * 6.28318530717958647692)};
}
template <> inline PointSimd::F acos_unit<PointSimd>(const PointSimd::F& x) {
  return {std::acos(x.value)};
}
template <> inline void sin_cos<PointSimd>(const PointSimd::F& x, PointSimd::F& sine, PointSimd::F& cosine) {
  sine = {std::sin(x.value)};
  cosine = {std::cos(x.value)};
}
template <> inline PointSimd::F turns_inline<PointSimd>(const PointSimd::F& y, const PointSimd::F& x) {
  if (x.value == 0 && y.value == 0) return {0}; // whatever the signs of the zeros
  return {std::atan2(y.value, x.value) / 6.28318530717958647692};
}
/// Returns the tolerance at lattice planes: it is tiny, because coordinates have not been rounded to single
/// precision.
template <> inline PointSimd::F lattice_epsilon<PointSimd>(const PointSimd::F&) {
  return {1e-9};
}

} // namespace kernel

} // namespace celltrace
