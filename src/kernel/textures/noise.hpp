// POV-Ray's solid noise: a value and a gradient at each lattice point, blended over the cells. Kernel
// dialect.
//
// Octaves, weights and tables are as measured from POV-Ray 3.7; in single precision.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "celltrace/spe/simd.hpp"
#include "kernel/math.hpp"
#include "kernel/textures/noise_tables.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel::noise {

/// The lattice points around the points of all lanes.
template <class S> struct LatticeCells {
  using F = typename S::F;
  using I = typename S::I;
  /// Numbers of the lattice planes below, for each axis.
  alignas(64) int32_t lattice[3][S::kLanes];
  F from[3];   ///< distance from the lattice planes below, in 0..1
  F weight[3]; ///< weight of the lattice planes above

  explicit LatticeCells(const V3<S>& p) {
    const F* const coordinate[3] = {&p.x, &p.y, &p.z};
    const I mask = I::splat(kPeriod - 1);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      I whole;
      const F a = fraction<S>(*coordinate[axis], whole);
      ((whole + I::splat(10000)) & mask).store(lattice[axis]);
      from[axis] = a;
      weight[axis] = a * a * (F(3.0f) - a - a);
    }
  }
  /// Lanes are in one cell if these keys, the numbers of the lattice planes below, are equal.
  static constexpr uint32_t kKeys = 3;
  const int32_t* keys(uint32_t axis) const { return lattice[axis]; }
  /// Finds the positions in kLattice of the eight points' numbers around a lane, in order of z, x, y.
  void operator()(uint32_t lane, uint32_t (&starts)[8]) const {
    const uint32_t plane = static_cast<uint32_t>(lattice[2][lane]);
    for (uint32_t i = 0; i < 4; ++i) {
      const uint32_t column = kHash.entry[column_index(lane, i)];
      starts[2 * i] = start(column ^ plane);
      starts[2 * i + 1] = start(column ^ above(plane));
    }
  }
  /// Finds indices for all lanes at once. start() of an index is the position that operator() finds.
  template <class LookUp>
  [[gnu::always_inline]] void find_indices(const LookUp& look_up, int32_t (&indices)[8][S::kLanes]) const {
    const auto index_of = [this](uint32_t lane, uint32_t corner) __attribute__((always_inline)) {
      return column_index(lane, corner);
    };
    using Numbers = typename LookUp::Numbers;
    Numbers columns[4];
    look_up(kHash.entry, index_of, columns);
    const Numbers plane = Numbers::load(lattice[2]);
    const Numbers next = (plane + Numbers::splat(1)) & Numbers::splat(kPeriod - 1);
    for (uint32_t i = 0; i < 4; ++i) {
      (columns[i] ^ plane).store(indices[2 * i]);
      (columns[i] ^ next).store(indices[2 * i + 1]);
    }
  }
  [[gnu::always_inline]] static uint32_t start(uint32_t index) { return kHash.entry[index] & 255; }

private:
  static uint32_t above(uint32_t plane) { return (plane + 1) & (kPeriod - 1); }
  /// Returns the index in kHash of the hash of a column along z through a corner of a lane's cell. Corners
  /// are in the order of x, y.
  [[gnu::always_inline]] uint32_t column_index(uint32_t lane, uint32_t corner) const {
    const uint32_t x = static_cast<uint32_t>(lattice[0][lane]), y = static_cast<uint32_t>(lattice[1][lane]);
    return kHash.entry[(corner & 1) != 0 ? above(x) : x] ^ ((corner & 2) != 0 ? above(y) : y);
  }
};

/// True where local store is short and one copy of the code therefore serves all callers. There, rare code
/// processes fewer lanes than a packet has.
template <class S> constexpr bool kOneCopy = S::kLanes < kSimdLanes;
/// Number of channels of noise that are computed for a value: three if one copy serves values and vectors.
template <class S> constexpr uint32_t kValueChannels = kOneCopy<S> ? 3 : 1;

/// Computes noise in `kChannels` coordinates, about 0.
template <class S, uint32_t kChannels>
[[gnu::always_inline]] inline void make_noise_inline(const V3<S>& p, typename S::F (&noise)[kChannels]) {
  using F = typename S::F;
  const LatticeCells<S> cells(p);
  // Half the weights of the cell's edges along x, by y and z. The weight of a lower corner is the rest of an
  // edge's weight after the upper corner's, and so on: differences instead of products.
  const F(&weight)[3] = cells.weight;
  F edge[2][2];
  const F upper_z = weight[2] * F(0.5f), lower_z = F(0.5f) - upper_z;
  edge[1][1] = weight[1] * upper_z;
  edge[0][1] = upper_z - edge[1][1];
  edge[1][0] = weight[1] * lower_z;
  edge[0][0] = lower_z - edge[1][0];
  const auto factors_of = [&](uint32_t row, F(&factors)[4]) __attribute__((always_inline)) {
    const bool is_upper[3] = {(row & 2) != 0, (row & 4) != 0, (row & 1) != 0};
    const F both = edge[is_upper[1]][is_upper[2]], upper = weight[0] * both;
    factors[0] = is_upper[0] ? upper : both - upper;
    const F share = factors[0] + factors[0];
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const F product = share * cells.from[axis];
      factors[1 + axis] = is_upper[axis] ? product - share : product;
    }
  };
  S::template sum_rows<8>(kLattice, cells, factors_of, noise);
}

template <class S, uint32_t kChannels>
CELLTRACE_ONE_COPY void make_noise(const V3<S>& p, typename S::F (&noise)[kChannels]) {
  make_noise_inline<S>(p, noise);
}

/// Returns noise in 0..1, scaled as by POV-Ray's generator 1 if `first_generator`, otherwise as by generator
/// 2.
template <class S> typename S::F value(const V3<S>& p, bool first_generator) {
  using F = typename S::F;
  F noise[kValueChannels<S>];
  make_noise<S>(p, noise);
  const F scaled = first_generator ? noise[0] + F(0.5f) : (noise[0] + F(1.05242f)) * F(0.48985582f);
  return S::min(S::max(scaled, F(0.0f)), F(1.0f));
}

/// Spreads noise of generator 2 about 0.5, for sums of octaves.
template <class S> typename S::F spread(const typename S::F& value, bool first_generator) {
  using F = typename S::F;
  return first_generator ? value : value + value - F(0.5f);
}
template <class S> typename S::F spread_value(const V3<S>& p, bool first_generator) {
  using F = typename S::F;
  const F spread_out = spread<S>(value<S>(p, first_generator), first_generator);
  return S::min(S::max(spread_out, F(0.0f)), F(1.0f));
}
/// Returns a sum of octaves of value(). As in POV-Ray, only the first octave is clipped. Not inlined, as one
/// copy serves all callers.
template <class S>
CELLTRACE_ONE_COPY typename S::F turbulence_value(const V3<S>& p, const TurbulenceWords& t,
                                                  bool first_generator) {
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

/// The noise source of generators 1 and 2 for patterns; that of generator 3 is GradientNoise.
template <class S> struct LatticeNoise {
  using F = typename S::F;
  const PatternRecord& record;

  [[gnu::always_inline]] F value(const V3<S>& p) const { return noise::value<S>(p, first_generator()); }
  [[gnu::always_inline]] F spread_value(const V3<S>& p) const {
    return noise::spread_value<S>(p, first_generator());
  }
  [[gnu::always_inline]] F turbulence_value(const V3<S>& p, const TurbulenceWords& t) const {
    return noise::turbulence_value<S>(p, t, first_generator());
  }
  [[gnu::always_inline]] bool first_generator() const {
    return (record.kind_and_flags & pattern_flag::first_generator) != 0;
  }
};

/// Returns noise in three coordinates, about 0.
template <class S> V3<S> vector(const V3<S>& p) {
  typename S::F noise[3];
  make_noise<S>(p, noise);
  return {noise[0], noise[1], noise[2]};
}

/// Sums octaves of the first coordinates of vector(), each `lambda` times finer and `omega` times weaker than
/// the previous one.
template <class S, uint32_t kChannels>
[[gnu::always_inline]] inline void add_octaves(const V3<S>& p, uint32_t octaves, float lambda, float omega,
                                               typename S::F (&sums)[kChannels]) {
  using F = typename S::F;
  for (F& sum : sums)
    sum = F(0.0f);
  float scale = 1.0f, strength = 1.0f;
  for (uint32_t octave = 0; octave < octaves; ++octave) {
    F noise[kChannels];
    if constexpr (kOneCopy<S>)
      make_noise<S>(p * F(scale), noise);
    else
      make_noise_inline<S>(p * F(scale), noise);
    for (uint32_t i = 0; i < kChannels; ++i)
      sums[i] = sums[i] + noise[i] * F(strength);
    scale *= lambda;
    strength *= omega;
  }
}
template <class S> V3<S> turbulence(const V3<S>& p, uint32_t octaves, float lambda, float omega) {
  typename S::F sums[3];
  add_octaves<S>(p, octaves, lambda, omega, sums);
  return {sums[0], sums[1], sums[2]};
}
/// Returns the first two coordinates of turbulence(); the third is 0 or, if one copy of the code serves both,
/// computed as well.
template <class S> V3<S> turbulence_across_z(const V3<S>& p, uint32_t octaves, float lambda, float omega) {
  using F = typename S::F;
  if constexpr (kOneCopy<S>) {
    return turbulence<S>(p, octaves, lambda, omega);
  } else {
    F sums[2];
    add_octaves<S>(p, octaves, lambda, omega, sums);
    return {sums[0], sums[1], F(0.0f)};
  }
}

} // namespace celltrace::kernel::noise
