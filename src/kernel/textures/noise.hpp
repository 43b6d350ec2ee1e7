// POV-Ray's solid noise: at each lattice point a value and a gradient, blended over the cells. Kernel
// dialect.
//
// The octaves, weights and tables are as measured from POV-Ray 3.7; in single precision.
#pragma once

#include "celltrace/spe/simd.hpp"
#include "kernel/math.hpp"
#include "kernel/records.hpp"
#include "kernel/textures/noise_tables.hpp"

namespace celltrace::kernel::noise {

/// The lattice points around the points of all lanes.
template <class S> struct LatticeCells {
  using F = typename S::F;
  using I = typename S::I;
  /// Numbers of the lattice planes on both sides, by axis.
  alignas(64) int32_t lattice[3][2][S::kLanes];
  F from[3][2]; ///< distance from them, signed
  F weight[3][2];

  explicit LatticeCells(const V3<S>& p) {
    const F* const coordinate[3] = {&p.x, &p.y, &p.z};
    const I mask = I::splat(kPeriod - 1);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      I whole;
      const F a = fraction<S>(*coordinate[axis], whole);
      const I below = (whole + I::splat(10000)) & mask;
      below.store(lattice[axis][0]);
      ((below + I::splat(1)) & mask).store(lattice[axis][1]);
      from[axis][0] = a;
      from[axis][1] = a - F(1.0f);
      weight[axis][1] = a * a * (F(3.0f) - a - a);
      weight[axis][0] = F(1.0f) - weight[axis][1];
    }
  }
  /// Whether all points are in the same cell.
  bool are_equal() const {
    int32_t difference = 0;
    for (uint32_t axis = 0; axis < 3; ++axis)
      for (uint32_t lane = 0; lane < S::kLanes; ++lane)
        difference |= lattice[axis][0][lane] ^ lattice[axis][0][0];
    return difference == 0;
  }
  /// Where in kLattice the numbers of the eight points around a lane are: in the order of z, x, y.
  void operator()(uint32_t lane, uint32_t (&starts)[8]) const {
    const uint32_t in_row[2] = {kHash.entry[lattice[0][0][lane]], kHash.entry[lattice[0][1][lane]]};
    const auto look_up = [&](uint32_t x, uint32_t y) __attribute__((always_inline)) {
      const uint32_t in_column = kHash.entry[in_row[x] ^ lattice[1][y][lane]];
      const uint32_t first = 2 * x + 4 * y;
      starts[first] = kHash.entry[in_column ^ lattice[2][0][lane]] & 255;
      starts[first + 1] = kHash.entry[in_column ^ lattice[2][1][lane]] & 255;
    };
    look_up(0, 0);
    look_up(1, 0);
    look_up(0, 1);
    look_up(1, 1);
  }
};

/// Noise in `kChannels` coordinates, about 0.
template <class S, uint32_t kChannels>
[[gnu::noinline]] void make_noise(const V3<S>& p, typename S::F (&noise)[kChannels]) {
  using F = typename S::F;
  const LatticeCells<S> cells(p);
  F factors[8][4];
  for (uint32_t column = 0; column < 4; ++column) {
    const uint32_t x = column & 1, y = column >> 1;
    const F weight = cells.weight[0][x] * cells.weight[1][y];
    for (uint32_t z = 0; z < 2; ++z) {
      const F share = weight * cells.weight[2][z];
      F(&row)[4] = factors[2 * column + z];
      row[0] = share * F(0.5f);
      row[1] = share * cells.from[0][x];
      row[2] = share * cells.from[1][y];
      row[3] = share * cells.from[2][z];
    }
  }
  S::sum_rows(kLattice, cells, factors, noise);
}

/// Where rare code takes fewer lanes than a packet has, local store is short: one copy of the code does for
/// values and vectors.
template <class S> constexpr uint32_t kValueChannels = S::kLanes < kSimdLanes ? 3 : 1;

/// In 0..1. `first_generator`: as POV-Ray's generator 1 scales it, otherwise as generator 2 does.
template <class S> typename S::F value(const V3<S>& p, bool first_generator) {
  using F = typename S::F;
  F noise[kValueChannels<S>];
  make_noise<S>(p, noise);
  const F scaled = first_generator ? noise[0] + F(0.5f) : (noise[0] + F(1.05242f)) * F(0.48985582f);
  return S::min(S::max(scaled, F(0.0f)), F(1.0f));
}

/// The same, spread about 0.5 by generator 2: what sums of octaves are made of.
template <class S> typename S::F spread(const typename S::F& value, bool first_generator) {
  using F = typename S::F;
  return first_generator ? value : value + value - F(0.5f);
}
template <class S> typename S::F spread_value(const V3<S>& p, bool first_generator) {
  using F = typename S::F;
  const F spread_out = spread<S>(value<S>(p, first_generator), first_generator);
  return S::min(S::max(spread_out, F(0.0f)), F(1.0f));
}
/// Octaves of value(). As in POV-Ray, only the first one is clipped.
template <class S>
typename S::F turbulence_value(const V3<S>& p, const TurbulenceWords& t, bool first_generator) {
  using F = typename S::F;
  F sum = spread_value<S>(p, first_generator);
  float scale = t.lambda, strength = t.omega;
  for (uint32_t octave = 1; octave < t.octaves; ++octave) {
    sum = sum + spread<S>(value<S>(p * F(scale), first_generator), first_generator) * F(strength);
    scale *= t.lambda;
    strength *= t.omega;
  }
  return sum;
}

/// Three coordinates, about 0.
template <class S> V3<S> vector(const V3<S>& p) {
  typename S::F noise[3];
  make_noise<S>(p, noise);
  return {noise[0], noise[1], noise[2]};
}

/// Octaves of vector(), each `lambda` times finer and `omega` times weaker than the one before.
template <class S> V3<S> turbulence(const V3<S>& p, uint32_t octaves, float lambda, float omega) {
  using F = typename S::F;
  const F zero(0.0f);
  V3<S> sum = {zero, zero, zero};
  float scale = 1.0f, strength = 1.0f;
  for (uint32_t octave = 0; octave < octaves; ++octave) {
    sum = sum + vector<S>(p * F(scale)) * F(strength);
    scale *= lambda;
    strength *= omega;
  }
  return sum;
}

} // namespace celltrace::kernel::noise
