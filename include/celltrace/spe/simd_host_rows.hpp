// The host's implementation of sum_rows() of Spu::simd (simd.hpp), which sums rows of a table: for all lanes
// at once if their rows are the same, otherwise lane by lane. Both ways do the same operations in the same
// order.
#pragma once

#include "celltrace/spe/simd_batch.hpp"

#include <stdint.h>

#include <utility>

namespace celltrace::simd_host {

/// Interleaves, in each 128 bits, the two lower or the two higher numbers of `a` and `b`.
template <class Batch> [[gnu::always_inline]] inline Batch zip_low(const Batch& a, const Batch& b) {
#if defined(__AVX512F__)
  if constexpr (Batch::size == 16) return _mm512_unpacklo_ps(a, b);
#endif
#if defined(__AVX__)
  if constexpr (Batch::size == 8) return _mm256_unpacklo_ps(a, b);
#endif
  if constexpr (Batch::size == 4) return zip_lo(a, b);
}
template <class Batch> [[gnu::always_inline]] inline Batch zip_high(const Batch& a, const Batch& b) {
#if defined(__AVX512F__)
  if constexpr (Batch::size == 16) return _mm512_unpackhi_ps(a, b);
#endif
#if defined(__AVX__)
  if constexpr (Batch::size == 8) return _mm256_unpackhi_ps(a, b);
#endif
  if constexpr (Batch::size == 4) return zip_hi(a, b);
}
template <class Batch>
[[gnu::always_inline]] inline void transpose_quads(Batch& a, Batch& b, Batch& c, Batch& d) {
  const Batch ac_low = zip_low(a, c), ac_high = zip_high(a, c);
  const Batch bd_low = zip_low(b, d), bd_high = zip_high(b, d);
  a = zip_low(ac_low, bd_low);
  b = zip_high(ac_low, bd_low);
  c = zip_low(ac_high, bd_high);
  d = zip_high(ac_high, bd_high);
}

/// Keeps compilers from moving the computation of `batch` down to its use.
template <class Batch> [[gnu::always_inline]] inline void keep_in_order([[maybe_unused]] Batch& batch) {
#if defined(__AVX__)
  asm("" : "+v"(batch.data));
#endif
}

/// Calls `body` with each index, without a loop, so that arrays of `body` stay in registers.
template <std::size_t... i, class Body>
[[gnu::always_inline]] inline void unroll(std::index_sequence<i...>, const Body& body) {
  (body(i), ...);
}
template <std::size_t kCount, class Body> [[gnu::always_inline]] inline void unroll(const Body& body) {
  unroll(std::make_index_sequence<kCount>(), body);
}

/// Implements sum_rows(); `S` is a HostSimd.
template <class S, uint32_t kRows, uint32_t kChannels> struct RowSums {
  using F = typename S::F;
  using F4 = typename S::F4;
  using Batch = typename S::FloatBatch;
  static constexpr uint32_t kLanes = S::kLanes;

  template <class StartsOf, class FactorsOf>
  [[gnu::always_inline]] static void sum(const float* table, const StartsOf& starts_of,
                                         const FactorsOf& factors_of, F (&sums)[kChannels]) {
    const uint32_t others = ~lanes_like(starts_of, 0) & ((1u << kLanes) - 1);
    uint32_t second = 0;
    if (others != 0) {
      // If one register holds all lanes, summing twice for all lanes is faster than once for each lane.
      if constexpr (S::kParts == 1) second = lanes_like(starts_of, first_of(others));
      if ((others & ~second) != 0) return sum_by_lane(table, starts_of, factors_of, sums);
    }
    sum_like(table, starts_of, 0, factors_of, sums);
    if (second != 0) replace_lanes(table, starts_of, second, factors_of, sums);
  }

private:
  static uint32_t first_of(uint32_t lanes) { return static_cast<uint32_t>(__builtin_ctz(lanes)); }

  /// Returns the lanes whose keys equal those of `lane`.
  template <class StartsOf>
  [[gnu::always_inline]] static uint32_t lanes_like(const StartsOf& starts_of, uint32_t lane) {
    using I = typename S::I;
    auto same = S::M::all();
    for (uint32_t i = 0; i < StartsOf::kKeys; ++i) {
      const int32_t* const keys = starts_of.keys(i);
      same = same & (I::load(keys) == I::splat(keys[lane]));
    }
    return same.bits();
  }

  /// Computes the sums of all lanes from the rows of one lane. The order, row by row and part by part, keeps
  /// the sums and a row's factors in registers.
  template <class StartsOf, class FactorsOf>
  [[gnu::always_inline]] static void sum_like(const float* table, const StartsOf& starts_of, uint32_t lane,
                                              const FactorsOf& factors_of, F (&sums)[kChannels]) {
    uint32_t starts[kRows];
    starts_of(lane, starts);
    unroll<S::kParts>([&](std::size_t part) __attribute__((always_inline)) {
      Batch four[kChannels][4];
      unroll<kRows>([&](std::size_t row) __attribute__((always_inline)) {
        const float* const numbers = table + starts[row];
        F factors[4];
        factors_of(static_cast<uint32_t>(row), factors);
        for (uint32_t channel = 0; channel < kChannels; ++channel)
          for (uint32_t i = 0; i < 4; ++i) {
            Batch& total = four[channel][i];
            const Batch product = Batch(numbers[4 * channel + i]) * factors[i].part[part];
            total = row == 0 ? product : total + product;
            keep_in_order(total);
          }
      });
      for (uint32_t channel = 0; channel < kChannels; ++channel)
        sums[channel].part[part] =
            (four[channel][0] + four[channel][1]) + (four[channel][2] + four[channel][3]);
    });
  }
  /// Replaces the sums of some lanes, whose rows are the same.
  template <class StartsOf, class FactorsOf>
  static void replace_lanes(const float* table, const StartsOf& starts_of, uint32_t lanes,
                            const FactorsOf& factors_of, F (&sums)[kChannels]) {
    F some[kChannels];
    sum_like(table, starts_of, first_of(lanes), factors_of, some);
    const auto chosen = S::M::from_bits(lanes);
    for (uint32_t channel = 0; channel < kChannels; ++channel)
      sums[channel] = S::select(chosen, some[channel], sums[channel]);
  }

#if defined(__AVX512F__)
  /// The `look_up` that starts_of.find_indices() gets (simd.hpp). It inserts numbers of the table into lanes
  /// of registers, because storing them one by one takes twice as long. It handles half the lanes at a time,
  /// so that values that several indices share stay in registers, too.
  struct LookUp {
    using Numbers = typename S::I;

    template <class IndexOf, std::size_t kCount>
    [[gnu::always_inline]] void operator()(const uint16_t* table, const IndexOf& index_of,
                                           Numbers (&numbers)[kCount]) const {
      __m128i half[2][kCount];
      unroll<2>([&](std::size_t h) __attribute__((always_inline)) {
        unroll<kCount>([&](std::size_t i) __attribute__((always_inline)) {
          half[h][i] = eight([&](uint32_t lane) __attribute__((always_inline)) {
            return table[index_of(8 * static_cast<uint32_t>(h) + lane, static_cast<uint32_t>(i))];
          });
        });
      });
      unroll<kCount>([&](std::size_t i) __attribute__((always_inline)) {
        numbers[i] = {typename S::IntBatch(_mm512_cvtepu16_epi32(_mm256_set_m128i(half[1][i], half[0][i])))};
      });
    }

  private:
    template <class NumberOf> [[gnu::always_inline]] static __m128i eight(const NumberOf& of) {
      __m128i numbers = _mm_cvtsi32_si128(of(0));
      numbers = _mm_insert_epi16(numbers, of(1), 1);
      numbers = _mm_insert_epi16(numbers, of(2), 2);
      numbers = _mm_insert_epi16(numbers, of(3), 3);
      numbers = _mm_insert_epi16(numbers, of(4), 4);
      numbers = _mm_insert_epi16(numbers, of(5), 5);
      numbers = _mm_insert_epi16(numbers, of(6), 6);
      return _mm_insert_epi16(numbers, of(7), 7);
    }
  };

  /// Sums lane by lane. Loads a row by one unaligned load for each pair of channels, and one load for the
  /// last channel if their number is odd. A channel's numbers of all lanes take four registers: lane 4q + i
  /// is the q-th quarter of the i-th register.
  template <class StartsOf, class FactorsOf>
  requires(kLanes == 16)
      static void sum_by_lane(const float* table, const StartsOf& starts_of, const FactorsOf& factors_of,
                              F (&sums)[kChannels]) {
    alignas(64) int32_t indices[kRows][kLanes];
    starts_of.find_indices(LookUp(), indices);
    asm("" : "+m"(indices)); // makes compilers store the indices, instead of extracting them from registers
    Batch four[kChannels][4];
    // Pairs of channels, side by side: `low` has lanes i and i + 4, `high` lanes i + 8 and i + 12.
    Batch low[kPairs + 1][4], high[kPairs + 1][4];
    unroll<kRows>([&](std::size_t row) __attribute__((always_inline)) {
      F factors[4];
      factors_of(static_cast<uint32_t>(row), factors);
      S::transpose_quads(factors[0], factors[1], factors[2], factors[3]);
      unroll<4>([&](std::size_t i) __attribute__((always_inline)) {
        const auto of = [&](std::size_t lane) __attribute__((always_inline)) {
          return table + starts_of.start(static_cast<uint32_t>(indices[row][lane]));
        };
        const float *const a = of(i), *const b = of(i + 4), *const c = of(i + 8), *const d = of(i + 12);
        const auto add = [row](Batch & total, const Batch& product) __attribute__((always_inline)) {
          total = row == 0 ? product : total + product;
          keep_in_order(total);
        };
        const __m512 f = factors[i].part[0];
        for (uint32_t pair = 0; pair < kPairs; ++pair) {
          const auto two = [pair](const float* first, const float* second) __attribute__((always_inline)) {
            return Batch(_mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(first + 8 * pair)),
                                            _mm256_loadu_ps(second + 8 * pair), 1));
          };
          add(low[pair][i], two(a, b) * Batch(_mm512_shuffle_f32x4(f, f, 0x50)));
          add(high[pair][i], two(c, d) * Batch(_mm512_shuffle_f32x4(f, f, 0xFA)));
        }
        for (uint32_t channel = 2 * kPairs; channel < kChannels; ++channel) {
          const auto load = [channel](const float* start) __attribute__((always_inline)) {
            return F4{F4::Batch::load_unaligned(start + 4 * channel)};
          };
          add(four[channel][i], S::join(load(a), load(b), load(c), load(d)).part[0] * factors[i].part[0]);
        }
      });
    });
    for (uint32_t pair = 0; pair < kPairs; ++pair)
      for (uint32_t i = 0; i < 4; ++i) {
        four[2 * pair][i] = _mm512_shuffle_f32x4(low[pair][i], high[pair][i], 0x88);
        four[2 * pair + 1][i] = _mm512_shuffle_f32x4(low[pair][i], high[pair][i], 0xDD);
      }
    for (uint32_t channel = 0; channel < kChannels; ++channel) {
      Batch(&sum)[4] = four[channel];
      transpose_quads(sum[0], sum[1], sum[2], sum[3]);
      sums[channel].part[0] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
  }
#endif
  /// Sums lane by lane. Loads a row by one unaligned load for each channel; gathering would take a load for
  /// each number.
  template <class StartsOf, class FactorsOf>
  static void sum_by_lane(const float* table, const StartsOf& starts_of, const FactorsOf& factors_of,
                          F (&sums)[kChannels]) {
    // The four factors of lane 4q + i are side by side at [i][4q].
    alignas(64) float factors_by_lane[kRows][4][kLanes];
    for (uint32_t row = 0; row < kRows; ++row) {
      F four[4];
      factors_of(row, four);
      S::transpose_quads(four[0], four[1], four[2], four[3]);
      for (uint32_t i = 0; i < 4; ++i)
        four[i].store(factors_by_lane[row][i]);
    }
    alignas(64) float of_lane[kChannels][kLanes];
    for (uint32_t quad = 0; quad < kLanes / 4; ++quad) {
      // The four sums of each of four lanes, by pair of channels, and by channel for a channel without a
      // pair.
      Pair pairs[kPairs + 1][4];
      F4 singles[kChannels][4];
      unroll<4>([&](std::size_t i) __attribute__((always_inline)) {
        uint32_t starts[kRows];
        starts_of(4 * quad + static_cast<uint32_t>(i), starts);
        unroll<kRows>([&](std::size_t row) __attribute__((always_inline)) {
          const float* const numbers = table + starts[row];
          const Factors factors(factors_by_lane[row][i] + 4 * quad);
          for (uint32_t pair = 0; pair < kPairs; ++pair)
            pairs[pair][i].add(row == 0, numbers + 8 * pair, factors);
          for (uint32_t channel = 2 * kPairs; channel < kChannels; ++channel) {
            const F4 product = F4{F4::Batch::load_unaligned(numbers + 4 * channel)} * factors.once();
            singles[channel][i] = row == 0 ? product : singles[channel][i] + product;
          }
        });
      });
      for (uint32_t pair = 0; pair < kPairs; ++pair)
        Pair::store_total(pairs[pair], of_lane[2 * pair] + 4 * quad, of_lane[2 * pair + 1] + 4 * quad);
      for (uint32_t channel = 2 * kPairs; channel < kChannels; ++channel) {
        F4(&four)[4] = singles[channel];
        transpose_quads(four[0].lanes, four[1].lanes, four[2].lanes, four[3].lanes);
        ((four[0] + four[1]) + (four[2] + four[3])).store(of_lane[channel] + 4 * quad);
      }
    }
    for (uint32_t channel = 0; channel < kChannels; ++channel)
      sums[channel] = F::load(of_lane[channel]);
  }

#if defined(__AVX__)
  /// Four factors, repeated in the upper half of a register.
  struct Factors {
    __m256 twice;

    [[gnu::always_inline]] explicit Factors(const float* four)
        : twice(_mm256_broadcast_ps(reinterpret_cast<const __m128*>(four))) {}
    [[gnu::always_inline]] F4 once() const { return {typename F4::Batch(_mm256_castps256_ps128(twice))}; }
  };
  /// The four sums of two channels, side by side in a register, so that one load and one product serve both
  /// channels.
  struct Pair {
    __m256 eight;

    [[gnu::always_inline]] void add(bool is_first, const float* numbers, const Factors& factors) {
      const __m256 product = _mm256_mul_ps(_mm256_loadu_ps(numbers), factors.twice);
      eight = is_first ? product : _mm256_add_ps(eight, product);
    }
    /// Stores the totals of four lanes.
    [[gnu::always_inline]] static void store_total(Pair (&of)[4], float* first, float* second) {
      const __m256 ab_low = _mm256_unpacklo_ps(of[0].eight, of[1].eight),
                   ab_high = _mm256_unpackhi_ps(of[0].eight, of[1].eight);
      const __m256 cd_low = _mm256_unpacklo_ps(of[2].eight, of[3].eight),
                   cd_high = _mm256_unpackhi_ps(of[2].eight, of[3].eight);
      const __m256 low =
          _mm256_add_ps(_mm256_shuffle_ps(ab_low, cd_low, 0x44), _mm256_shuffle_ps(ab_low, cd_low, 0xEE));
      const __m256 high =
          _mm256_add_ps(_mm256_shuffle_ps(ab_high, cd_high, 0x44), _mm256_shuffle_ps(ab_high, cd_high, 0xEE));
      const __m256 both = _mm256_add_ps(low, high);
      _mm_store_ps(first, _mm256_castps256_ps128(both));
      _mm_store_ps(second, _mm256_extractf128_ps(both, 1));
    }
  };
  static constexpr uint32_t kPairs = kChannels / 2;
#else
  struct Factors {
    F4 four;

    explicit Factors(const float* numbers) : four(F4::load(numbers)) {}
    F4 once() const { return four; }
  };
  struct Pair {
    void add(bool, const float*, const Factors&) {}
    static void store_total(Pair (&)[4], float*, float*) {}
  };
  static constexpr uint32_t kPairs = 0;
#endif
};

} // namespace celltrace::simd_host
