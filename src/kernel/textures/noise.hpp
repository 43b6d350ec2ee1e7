// POV-Ray's solid noise: at each lattice point a value and a gradient, blended over the cells. Kernel
// dialect.
//
// The octaves, weights and tables are as measured from POV-Ray 3.7; in single precision.
#pragma once

#include "kernel/math.hpp"
#include "kernel/textures/noise_tables.hpp"

namespace celltrace::kernel::noise {

/// The cells that sixteen points are in, by axis.
template <class S> struct LatticeCells {
  using F = typename S::F;
  using I = typename S::I;
  I lattice[3][2]; ///< numbers of the lattice planes on both sides
  F from[3][2];    ///< distance from them, signed
  F weight[3][2];

  explicit LatticeCells(const V3<S>& p) {
    const F* const coordinate[3] = {&p.x, &p.y, &p.z};
    const I mask = I::splat(kPeriod - 1);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      I whole;
      const F a = fraction<S>(*coordinate[axis], whole);
      lattice[axis][0] = (whole + I::splat(10000)) & mask;
      lattice[axis][1] = (lattice[axis][0] + I::splat(1)) & mask;
      from[axis][0] = a;
      from[axis][1] = a - F(1.0f);
      weight[axis][1] = a * a * (F(3.0f) - a - a);
      weight[axis][0] = F(1.0f) - weight[axis][1];
    }
  }
};

/// Adds noise in `kChannels` coordinates to `sum`, times `factor`.
template <class S, uint32_t kChannels>
[[gnu::noinline]] void add_noise(const V3<S>& p, float factor, typename S::F (&sum)[kChannels]) {
  using F = typename S::F;
  using I = typename S::I;
  const LatticeCells<S> cells(p);
  for (uint32_t column = 0; column < 4; ++column) {
    const uint32_t x = column & 1, y = column >> 1;
    const I in_row = S::gather(kHash.entry, cells.lattice[0][x]) ^ cells.lattice[1][y];
    const I in_column = S::gather(kHash.entry, in_row);
    const F weight = cells.weight[0][x] * cells.weight[1][y] * F(factor);
    for (uint32_t z = 0; z < 2; ++z) {
      const I point = S::gather(kHash.entry, in_column ^ cells.lattice[2][z]) & I::splat(255);
      const F share = weight * cells.weight[2][z];
      for (uint32_t channel = 0; channel < kChannels; ++channel) {
        const float* const table = kLattice + 4 * channel;
        const F value = S::gather(table, point) * F(0.5f) + S::gather(table + 1, point) * cells.from[0][x] +
                        S::gather(table + 2, point) * cells.from[1][y] +
                        S::gather(table + 3, point) * cells.from[2][z];
        sum[channel] = sum[channel] + share * value;
      }
    }
  }
}

/// In 0..1. `first_generator`: as POV-Ray's generator 1 scales it, otherwise as generator 2 does.
template <class S> typename S::F value(const V3<S>& p, bool first_generator) {
  using F = typename S::F;
  F sum[1] = {F(0.0f)};
  add_noise<S>(p, 1.0f, sum);
  const F scaled = first_generator ? sum[0] + F(0.5f) : (sum[0] + F(1.05242f)) * F(0.48985582f);
  return S::min(S::max(scaled, F(0.0f)), F(1.0f));
}

/// Three coordinates, about 0.
template <class S> V3<S> vector(const V3<S>& p) {
  using F = typename S::F;
  F sum[3] = {F(0.0f), F(0.0f), F(0.0f)};
  add_noise<S>(p, 1.0f, sum);
  return {sum[0], sum[1], sum[2]};
}

/// Octaves of vector(), each `lambda` times finer and `omega` times weaker than the one before.
template <class S> V3<S> turbulence(const V3<S>& p, uint32_t octaves, float lambda, float omega) {
  using F = typename S::F;
  F sum[3] = {F(0.0f), F(0.0f), F(0.0f)};
  float scale = 1.0f, strength = 1.0f;
  for (uint32_t octave = 0; octave < octaves; ++octave) {
    add_noise<S>(p * F(scale), strength, sum);
    scale *= lambda;
    strength *= omega;
  }
  return {sum[0], sum[1], sum[2]};
}

} // namespace celltrace::kernel::noise
